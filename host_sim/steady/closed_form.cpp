#include "host_sim/steady/requirement.hpp"

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

#include "firmware/friction/coulomb_friction_ratio.hpp"
#include "firmware/friction/dahl_friction_ratio.hpp"
#include "firmware/friction/iwan_friction_ratio.hpp"
#include "firmware/friction/lugre_friction_ratio.hpp"
#include "firmware/friction/normal_vibration_ratio.hpp"
#include "firmware/friction/stribeck_friction_ratio.hpp"
#include "firmware/friction/transverse_vibration_ratio.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/steady/root.hpp"

namespace sonoglide::steady {
namespace {

namespace laws = scene::laws;

/// Mean friction over μN, by law.
struct MeanFriction {
  const scene::Scene& scene;
  double sliding_m_per_s;
  double vibration_m_per_s;

  double operator()(const laws::None& /*law*/) const { return 1.0; }
  double operator()(const laws::Coulomb& /*law*/) const {
    return friction::coulomb_friction_ratio(velocity_ratio());
  }
  double operator()(const laws::Dahl& /*law*/) const {
    return friction::dahl_friction_ratio(velocity_ratio(), contact_number());
  }
  double operator()(const laws::Iwan& law) const {
    return friction::iwan_friction_ratio(velocity_ratio(), contact_number(),
                                         static_cast<std::size_t>(law.elements));
  }
  double operator()(const laws::LuGre& law) const {
    const friction::LuGreShape contact{
        contact_number(), law.static_coefficient / scene.friction.coefficient,
        law.stribeck_velocity_m_per_s / vibration_m_per_s,
        law.viscous_friction_N_s_per_m * vibration_m_per_s / scene.friction.limit_N()};
    return friction::lugre_mean_friction(velocity_ratio(), contact);
  }
  double operator()(const laws::Stribeck& law) const {
    const double v = vibration_m_per_s;
    const double coefficient = scene.friction.coefficient;
    return friction::stribeck_friction_ratio(velocity_ratio(), law.fall_s_per_m * v / coefficient,
                                             law.rise_s3_per_m3 * v * v * v / coefficient);
  }
  double operator()(const laws::TransverseCoulomb& /*law*/) const {
    return friction::transverse_vibration_ratio(velocity_ratio());
  }
  double operator()(const laws::NormalCoulomb& law) const {
    const scene::Friction& contact = scene.friction;
    const double critical_part = contact.coefficient * law.normal_contact_stiffness_N_per_m /
                                 contact.contact_stiffness_N_per_m;
    return friction::normal_vibration_ratio(
        law.normal_contact_stiffness_N_per_m * amplitude_m() / contact.normal_force_N,
        velocity_ratio() / critical_part);
  }

 private:
  double velocity_ratio() const { return sliding_m_per_s / vibration_m_per_s; }
  double amplitude_m() const { return vibration_m_per_s / carrier_rad_per_s(scene); }
  double contact_number() const {
    return scene.friction.contact_stiffness_N_per_m * amplitude_m() / scene.friction.limit_N();
  }
};

/// Of peak velocities.
struct VibrationRange {
  double least_m_per_s;
  double most_m_per_s;
};

VibrationRange vibrations(const scene::Scene& scene, double sliding_m_per_s) {
  constexpr double least = 1e-3;
  constexpr double most = 1e6;
  if (const auto* law = std::get_if<laws::NormalCoulomb>(&scene.friction.law)) {
    const double opening_m_per_s = carrier_rad_per_s(scene) * scene.friction.normal_force_N /
                                   law->normal_contact_stiffness_N_per_m;
    return {opening_m_per_s / most, opening_m_per_s};
  }
  return {least * sliding_m_per_s, most * sliding_m_per_s};
}

}  // namespace

double carrier_rad_per_s(const scene::Scene& scene) {
  return numeric::two_pi * scene.drive->frequency_Hz;
}

double closed_form_ratio(const scene::Scene& scene, double sliding_m_per_s,
                         double vibration_m_per_s) {
  const scene::Friction& friction = scene.friction;
  return std::visit(MeanFriction{scene, sliding_m_per_s, vibration_m_per_s}, friction.law) *
         friction.limit_N() / scene::undriven_friction_N(friction.law, friction, sliding_m_per_s);
}

/// The first step of a scan over the vibration that leads below the ratio, then a root in it; where
/// none does, the minimum about the lowest place.
RequiredVibration closed_form_vibration(const scene::Scene& scene, double sliding_m_per_s,
                                        double ratio) {
  constexpr int steps = 120;
  const auto [least_m_per_s, most_m_per_s] = vibrations(scene, sliding_m_per_s);
  const double span = std::log(most_m_per_s / least_m_per_s);
  const auto vibration_m_per_s = [&, most = most_m_per_s](double place) {
    return most * std::exp(span * (place / steps - 1.0));
  };
  const auto excess_under = [&](double velocity_m_per_s) {
    return closed_form_ratio(scene, sliding_m_per_s, velocity_m_per_s) - ratio;
  };
  const auto excess = [&](double place) { return excess_under(vibration_m_per_s(place)); };
  double lowest = 0.0;
  double lowest_excess = excess(0.0);
  for (int i = 1; i <= steps && lowest_excess >= 0.0; ++i) {
    const double here = excess(i);
    if (here < lowest_excess) {
      lowest = i;
      lowest_excess = here;
    }
  }
  if (lowest_excess >= 0.0) {
    constexpr int minimum_bits = 26;
    const auto [place, least] = boost::math::tools::brent_find_minima(
        excess, std::max(0.0, lowest - 1.0), std::min(lowest + 1.0, double{steps}), minimum_bits);
    if (least < lowest_excess) {
      lowest = place;
      lowest_excess = least;
    }
  }
  if (lowest_excess >= 0.0 || lowest == 0.0) {
    return {ratio + std::max(0.0, lowest_excess), vibration_m_per_s(lowest)};
  }
  return {ratio, root_between(excess_under, vibration_m_per_s(std::ceil(lowest) - 1.0),
                              vibration_m_per_s(lowest))};
}

double force_N(const scene::Scene& scene, double vibration_m_per_s) {
  const double omega = carrier_rad_per_s(scene);
  return configure::dynamic_stiffness_N_per_m(scene.plant, omega) * vibration_m_per_s / omega;
}

}  // namespace sonoglide::steady
