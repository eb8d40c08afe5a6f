#include "host_sim/configure/nominal_plant.hpp"

#include <algorithm>

namespace sonoglide::configure {
namespace {

/// The friction force that the first slide of the scene meets without vibration.
double first_undriven_friction_N(const scene::Scene& scene) {
  const auto& profile = scene.sliding.profile;
  const auto moves = [](const scene::SpeedPoint& point) { return point.velocity_m_per_s != 0.0; };
  const auto first = std::find_if(profile.begin(), profile.end(), moves);
  return scene::undriven_friction_N(scene.friction.law, scene.friction,
                                    first == profile.end() ? 0.0 : first->velocity_m_per_s);
}

}  // namespace

std::vector<double> NominalPlant::target_ratios(const scene::Controller& controller) const {
  std::vector<double> ratios;
  for (const double target : controller.target_values()) {
    ratios.push_back(controller.holds_force() ? std::min(1.0, target / friction_N) : target);
  }
  return ratios;
}

NominalPlant nominal_plant(const scene::Scene& scene) {
  const scene::ModelError& error = scene.model_error;
  NominalPlant plant{scene.plant, first_undriven_friction_N(scene) * error.coefficient,
                     scene.friction.contact_stiffness_N_per_m * error.contact_stiffness,
                     error.force_factor};
  plant.mass_kg *= error.mass;
  plant.stiffness_N_per_m *= error.stiffness;
  plant.damping_N_s_per_m *= error.damping;
  return plant;
}

}  // namespace sonoglide::configure
