#include "host_sim/loop/plant/undriven_friction.hpp"

#include <cmath>
#include <cstddef>

#include "firmware/numeric/gauss_legendre.hpp"
#include "host_sim/configure/plant_scales.hpp"

namespace sonoglide::loop {

UndrivenFriction::UndrivenFriction(const scene::Scene& scene)
    : friction_(scene.friction),
      largest_N_(scene.friction.largest_limit_N()),
      is_limit_(!scene.friction.has_profile() && scene::is_bounded(scene.friction.law)),
      has_load_(scene.load) {}

void UndrivenFriction::complete(const Stretch& stretch, EnergyBalance& energy) const {
  if (!(largest_N_ > 0.0)) {
    return;
  }
  energy.limit_distance_m = energy.sliding_distance_m;
  if (has_load_) {
    return;
  }
  energy.undriven_s = energy.duration_s;
  if (is_limit_) {
    return;
  }
  if (friction_.has_profile() || stretch.sliding_acceleration_m_per_s2 != 0.0) {
    follow(stretch, energy);
  } else {
    energy.undriven_s *= part_of_largest(friction_, stretch.sliding_velocity_m_per_s);
  }
}

double UndrivenFriction::part_of_largest(const scene::ContactValues& contact,
                                         double sliding_m_per_s) const {
  return scene::undriven_friction_N(friction_.law, contact, sliding_m_per_s) / largest_N_;
}

void UndrivenFriction::follow(const Stretch& stretch, EnergyBalance& energy) const {
  static constexpr auto rule = numeric::gauss_legendre<24>();
  double undriven = 0.0;
  double travel_m_per_s = 0.0;
  for (std::size_t i = 0; i < rule.node.size(); ++i) {
    const double offset_s = rule.node[i] * stretch.duration_s;
    const scene::ContactValues contact =
        configure::contact_at(friction_, stretch.begin_s + offset_s);
    const double sliding_m_per_s =
        stretch.sliding_velocity_m_per_s + stretch.sliding_acceleration_m_per_s2 * offset_s;
    undriven += rule.weight[i] * part_of_largest(contact, sliding_m_per_s);
    travel_m_per_s += rule.weight[i] * contact.limit_N() / largest_N_ * std::abs(sliding_m_per_s);
  }
  energy.undriven_s = stretch.duration_s * undriven;
  energy.limit_distance_m = stretch.duration_s * travel_m_per_s;
}

}  // namespace sonoglide::loop
