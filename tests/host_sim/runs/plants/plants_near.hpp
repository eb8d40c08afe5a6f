/// Closed loops on plants that are not quite the one that their controller was designed for.
#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "host_sim/scene/scene.hpp"

namespace sonoglide::runs {

/// Plants near that of a scene; of its stiffness and mass within this tolerance.
inline std::vector<scene::Scene> plants_near(const scene::Scene& nominal, std::size_t count,
                                             double stiffness_tolerance) {
  std::mt19937_64 generator(5);
  const auto within = [&generator](double tolerance) {
    return 1.0 + tolerance * (2.0 * static_cast<double>(generator() >> 11) * 0x1p-53 - 1.0);
  };
  std::vector<scene::Scene> plants(count, nominal);
  for (scene::Scene& plant : plants) {
    plant.plant.stiffness_N_per_m *= within(stiffness_tolerance);
    plant.plant.mass_kg *= within(stiffness_tolerance);
    plant.plant.damping_N_s_per_m = 50.0 * within(1.0);
    plant.friction.coefficient *= within(0.02);
    plant.friction.contact_stiffness_N_per_m *= within(0.1);
    plant.sliding.profile.front().velocity_m_per_s *= within(0.02);
    plant.drive->frequency_Hz *= within(0.25 * stiffness_tolerance);
  }
  return plants;
}

}  // namespace sonoglide::runs
