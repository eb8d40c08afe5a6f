#include "host_sim/loop/plant/sloping_contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

#include "host_sim/configure/plant_scales.hpp"

namespace sonoglide::loop {
namespace {

using scene::laws::Dahl;
using scene::laws::Iwan;
using scene::laws::LuGre;
using scene::laws::NormalCoulomb;

bool is_at(double force_N, double limit_N) {
  constexpr double of_limit = 1e-12;
  return limit_N > 0.0 && std::abs(force_N) >= limit_N * (1.0 - of_limit);
}

/// 1/2 + exp(-a)/2 - (1 - exp(-a))/a, a >= 0.
double lagging_part(double a) {
  if (a < 0.01) {
    return a * a * (1.0 / 12.0 - a * (1.0 / 24.0 - a / 80.0));
  }
  const double relaxed = -std::expm1(-a);
  return 1.0 - 0.5 * relaxed - relaxed / a;
}

/// Mean of what a limit cuts off a line that begins below it and would end above it, else 0.
double cut_off(double below, double above) {
  return above > 0.0 ? 0.5 * above * above / (std::max(0.0, below) + above) : 0.0;
}

}  // namespace

void SlopingContact::set_out(const HeldPlant::Carried& begin, PlantPort& plant) {
  std::vector<double> parts = plant.memory();
  const std::vector<double> plant_N = plant.memory_limits_N();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    // A contact that had no friction so far remembers nothing.
    const double force_N = i < begin.forces_N.size() ? begin.forces_N[i] : 0.0;
    const double own_N = moved_limit_N(plant_N[i], limits_.begin);
    const bool stays = is_at(force_N, own_N) &&
                       stays_at_limit(force_N, plant_N[i], piece_.sliding_velocity_m_per_s,
                                      begin.state.velocity_m_per_s);
    if (stays) {
      parts[i] = std::copysign(1.0, force_N);
    }
    begun_.push_back({force_N, own_N, plant_N[i], stays});
  }
  plant.begin_at(plant.state(), parts);
}

HeldPlant::Carried SlopingContact::arrive(const PlantState& begin, const PlantPort& plant,
                                          EnergyBalance& energy) const {
  HeldPlant::Carried end{plant.state(), plant.memory()};
  const std::vector<double> plant_N = plant.memory_limits_N();
  double missed_N_s = 0.0;
  for (std::size_t i = 0; i < plant_N.size(); ++i) {
    double& force_N = end.forces_N[i];
    force_N *= plant_N[i];
    missed_N_s += lead(begun_[i], begin, end.state, plant_N[i], force_N);
  }
  add_impulse(missed_N_s, begin, end.state, energy);
  return end;
}

/// Leads a force from the plant's to what the slope makes of it.
/// @return the impulse that the plant misses
double SlopingContact::lead(const Begun& begun, const PlantState& begin, const PlantState& end,
                            double plant_N, double& force_N) const {
  const double length_s = piece_.duration_s;
  const double own_N = moved_limit_N(plant_N, limits_.end);
  const double fall_N = plant_N - std::abs(force_N);
  const double sliding_m_per_s =
      piece_.sliding_velocity_m_per_s + piece_.sliding_acceleration_m_per_s2 * length_s;
  // A force that has left the limit by more than that has changed was not there all the time.
  const double change_N = own_N - moved_limit_N(plant_N, limits_.begin);
  if (begun.stays && fall_N <= std::abs(change_N) &&
      stays_at_limit(force_N, plant_N, sliding_m_per_s, end.velocity_m_per_s)) {
    const double lost_N = 0.5 * (begun.own_N - begun.plant_N + own_N - plant_N + fall_N);
    const double sign = force_N < 0.0 ? -1.0 : 1.0;
    force_N = sign * own_N;
    return sign * lost_N * length_s;
  }
  if (begun.stays) {
    return 0.0;
  }
  const bool relaxes = scene::is<Dahl>(friction_.law) || scene::is<LuGre>(friction_.law);
  const double missed_N_s =
      relaxes ? lag(begun, begin, end, force_N) : load(begun, begin, end, plant_N, force_N);
  const double side = force_N < 0.0 ? -1.0 : 1.0;
  const double over_N = side * force_N - own_N;
  const double cut_off_N_s = side * cut_off(begun.own_N - side * begun.force_N, over_N) * length_s;
  force_N = std::clamp(force_N, -own_N, own_N);
  return missed_N_s - cut_off_N_s;
}

/// A slider that does not set out at its limit for good: what its spring loads it to.
double SlopingContact::load(const Begun& begun, const PlantState& begin, const PlantState& end,
                            double plant_N, double& force_N) const {
  const double plant_begin_N = std::clamp(begun.force_N, -begun.plant_N, begun.plant_N);
  const double clamped_N = begun.force_N - plant_begin_N;
  double cut_off_N = 0.0;
  if (is_at(force_N, plant_N)) {
    const double side = force_N < 0.0 ? -1.0 : 1.0;
    const double loaded_N = plant_begin_N + loading_N_per_s(begin, end) * piece_.duration_s;
    cut_off_N = side * cut_off(begun.plant_N - side * plant_begin_N, side * loaded_N - plant_N);
    force_N = side * std::max(side * loaded_N, plant_N);
  }
  force_N += clamped_N;
  return (clamped_N + cut_off_N) * piece_.duration_s;
}

/// Of one spring, the mean over the piece.
double SlopingContact::loading_N_per_s(const PlantState& begin, const PlantState& end) const {
  const double stiffness = limits_.middle.contact_stiffness_N_per_m;
  const auto* iwan = std::get_if<Iwan>(&friction_.law);
  return iwan != nullptr ? stiffness / iwan->elements * mean_contact_m_per_s(begin, end)
                         : stiffness * mean_sliding_m_per_s();
}

/// Of what the contact remembers.
/// @param limit_N  under the contact of the middle
double SlopingContact::moved_limit_N(double limit_N, const scene::ContactValues& to) const {
  const scene::ContactValues& from = limits_.middle;
  if (scene::is<LuGre>(friction_.law)) {
    return limit_N * (to.normal_force_N / from.normal_force_N);
  }
  if (scene::is<NormalCoulomb>(friction_.law)) {
    const double pressure_N = limit_N / from.coefficient + to.normal_force_N - from.normal_force_N;
    return limit_N > 0.0 ? std::max(0.0, to.coefficient * pressure_N) : 0.0;
  }
  return limit_N * (to.limit_N() / from.limit_N());
}

/// @param force_N  tells the side
/// @param limit_N  under the contact of the middle
bool SlopingContact::stays_at_limit(double force_N, double limit_N, double sliding_m_per_s,
                                    double velocity_m_per_s) const {
  const double sign = force_N < 0.0 ? -1.0 : 1.0;
  const double limit_N_per_s =
      (moved_limit_N(limit_N, limits_.end) - moved_limit_N(limit_N, limits_.begin)) /
      piece_.duration_s;
  const double stiffness = limits_.middle.contact_stiffness_N_per_m;
  if (const auto* normal = std::get_if<NormalCoulomb>(&friction_.law)) {
    const double pressing_N_per_s =
        limits_.middle.coefficient * normal->normal_contact_stiffness_N_per_m * velocity_m_per_s;
    return sign * stiffness * sliding_m_per_s - pressing_N_per_s >= limit_N_per_s;
  }
  const double contact_m_per_s = contact_velocity_m_per_s(sliding_m_per_s, velocity_m_per_s);
  if (const auto* iwan = std::get_if<Iwan>(&friction_.law)) {
    return sign * stiffness / iwan->elements * contact_m_per_s >= limit_N_per_s;
  }
  const double relaxing_m_per_s =
      std::abs(contact_m_per_s) * (limit_N / steady_N(limits_.middle, contact_m_per_s));
  return stiffness * (sign * contact_m_per_s - relaxing_m_per_s) >= limit_N_per_s;
}

/// G of bristles.
double SlopingContact::steady_N(const scene::ContactValues& contact, double contact_m_per_s) const {
  const auto* lugre = std::get_if<LuGre>(&friction_.law);
  const double viscous_N_s_per_m = lugre != nullptr ? lugre->viscous_friction_N_s_per_m : 0.0;
  return scene::undriven_friction_N(friction_.law, contact, contact_m_per_s) -
         viscous_N_s_per_m * std::abs(contact_m_per_s);
}

/// Of bristles.
double SlopingContact::lag(const Begun& begun, const PlantState& begin, const PlantState& end,
                           double& force_N) const {
  const double length_s = piece_.duration_s;
  const double contact_m_per_s = mean_contact_m_per_s(begin, end);
  const double stiffness_N_per_m = limits_.middle.contact_stiffness_N_per_m;
  const double steady = steady_N(limits_.middle, contact_m_per_s);
  const double relaxation = stiffness_N_per_m * std::abs(contact_m_per_s) * length_s / steady;
  const double cut_N = begun.force_N - std::clamp(begun.force_N, -begun.plant_N, begun.plant_N);
  if (!(relaxation > 0.0)) {
    return 0.0;
  }
  const double change =
      (steady_N(limits_.end, contact_m_per_s) - steady_N(limits_.begin, contact_m_per_s)) / steady;
  const double added_N = force_N * change * lagging_part(relaxation);
  const auto* lugre = std::get_if<LuGre>(&friction_.law);
  const double bristle_damping = lugre != nullptr ? lugre->bristle_damping_N_s_per_m : 0.0;
  force_N += added_N + cut_N * std::exp(-relaxation);
  return added_N * (bristle_damping / stiffness_N_per_m - length_s / relaxation) -
         cut_N * std::expm1(-relaxation) * length_s / relaxation;
}

/// To the friction of the piece.
void SlopingContact::add_impulse(double impulse_N_s, const PlantState& begin, PlantState& end,
                                 EnergyBalance& energy) const {
  const double sliding_m_per_s = mean_sliding_m_per_s();
  energy.friction_impulse_N_s += impulse_N_s;
  energy.resistance_impulse_N_s += sliding_m_per_s < 0.0 ? -impulse_N_s : impulse_N_s;
  energy.pull_work_J += impulse_N_s * sliding_m_per_s;
  if (scene::vibrates_along(friction_.law)) {
    energy.friction_work_J += impulse_N_s * mean_contact_m_per_s(begin, end);
    end.velocity_m_per_s -= impulse_N_s / mass_kg_;
  } else {
    energy.friction_work_J += impulse_N_s * sliding_m_per_s;
  }
}

double SlopingContact::mean_sliding_m_per_s() const {
  return piece_.sliding_velocity_m_per_s +
         0.5 * piece_.sliding_acceleration_m_per_s2 * piece_.duration_s;
}

double SlopingContact::contact_velocity_m_per_s(double sliding_m_per_s,
                                                double velocity_m_per_s) const {
  return sliding_m_per_s +
         configure::vibration_sign(limits_.middle.sign_convention) * velocity_m_per_s;
}

double SlopingContact::mean_contact_m_per_s(const PlantState& begin, const PlantState& end) const {
  const double moved_m = end.displacement_m - begin.displacement_m;
  return contact_velocity_m_per_s(mean_sliding_m_per_s(), moved_m / piece_.duration_s);
}

}  // namespace sonoglide::loop
