#include "host_sim/batch/lane_plant.hpp"

#include <cmath>

namespace sonoglide::batch {
namespace {

constexpr double softest_contact = 1e-9;
constexpr double stiffest_contact = 1e9;

bool lies_within(double value, double lowest, double highest) {
  return lowest <= value && value <= highest;
}

}  // namespace

bool suits_lanes(const DahlPlant& plant) {
  return std::abs(plant.drive_amplitude) < farthest && lies_within(plant.damping, 0.0, farthest) &&
         lies_within(plant.stiffness, 0.0, farthest) &&
         lies_within(plant.friction_force, 0.0, farthest) &&
         lies_within(plant.contact_stiffness, softest_contact, stiffest_contact) &&
         std::abs(plant.sliding_velocity) < farthest && std::abs(plant.vibration_sign) == 1.0 &&
         plant::is_finite(plant.initial) && std::abs(plant.initial.friction) <= 1.0;
}

LanePlant prepare(const DahlPlant& plant) {
  const double natural_frequency = std::sqrt(plant.stiffness);
  const double contact_frequency = std::sqrt(plant.friction_force * plant.contact_stiffness);
  return {plant, natural_frequency, 0.5 + natural_frequency + plant.damping + contact_frequency};
}

RunStatus status_of(const Progress& progress) {
  if (!plant::is_finite(progress.state) ||
      std::abs(progress.state.displacement) + std::abs(progress.state.velocity) >= farthest) {
    return RunStatus::not_finite;
  }
  return progress.periods_left > 0.0 ? RunStatus::too_many_steps : RunStatus::solved;
}

}  // namespace sonoglide::batch
