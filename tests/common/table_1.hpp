/// Scenes of the paper's Table 1 as the tests vary them.
#pragma once

#include <cmath>

#include "host_sim/scene/scene.hpp"
#include "tests/common/constants/table_1_numbers.hpp"

namespace sonoglide::tests {

inline constexpr double carrier_Hz = Table1::carrier_Hz;
inline constexpr double period_s = 1.0 / carrier_Hz;

/// Signed steady displacement per unit of drive force at drive phase 0, without friction.
inline double compliance_m_per_N(const scene::Plant& plant) {
  const double omega = 2.0 * pi * carrier_Hz;
  return 1.0 / (plant.stiffness_N_per_m - plant.mass_kg * omega * omega);
}

/// Peak vibration velocity of the steady state.
inline double vibration_velocity_m_per_s(const scene::Plant& plant, double force_N) {
  return std::abs(force_N * compliance_m_per_N(plant)) * 2.0 * pi * carrier_Hz;
}

/// Open loop from rest: a hundred carrier periods, the window over the second half, sliding at half
/// the peak vibration velocity.
inline scene::Scene table_1(double force_N = 384.0) {
  scene::Scene scene;
  scene.plant.mass_kg = Table1::mass_kg;
  scene.plant.stiffness_N_per_m = Table1::stiffness_N_per_m;
  scene.friction.law = scene::laws::Dahl{};
  scene.friction.coefficient = Table1::friction_coefficient;
  scene.friction.normal_force_N = Table1::normal_force_N;
  scene.friction.contact_stiffness_N_per_m = Table1::contact_stiffness_N_per_m;
  scene.sliding.profile = {{0.0, 0.5 * vibration_velocity_m_per_s(scene.plant, force_N)}};
  scene.drive.emplace();
  scene.drive->frequency_Hz = carrier_Hz;
  scene.drive->force_amplitude_N = force_N;
  scene.run.duration_s = 100.0 * period_s;
  scene.run.window_start_s = 50.0 * period_s;
  return scene;
}

/// Starts a scene on its steady orbit: no free motion of the natural mode.
inline scene::Scene on_steady_orbit(scene::Scene scene) {
  scene.plant.initial_displacement_m =
      scene.drive->force_amplitude_N * compliance_m_per_N(scene.plant);
  return scene;
}

/// Closed loop: a target from 0 on, another from 1 ms on, 2 ms in all; ideal sensor.
inline scene::Scene table_1_closed_loop(scene::Arithmetic arithmetic = scene::Arithmetic::float64) {
  scene::Scene scene = table_1();
  scene.sliding.profile = {{0.0, 0.02672}};
  scene.drive->force_amplitude_N = 0.0;
  scene.drive->max_force_amplitude_N = 1920.0;
  scene.run.duration_s = 2e-3;
  scene.run.window_start_s = 0.0;
  scene.controller.emplace();
  scene.controller->arithmetic = arithmetic;
  scene.controller->target_friction_ratio = {{0.0, 0.4}, {1e-3, 0.6}};
  scene.sensor.force_full_scale_N =
      2.0 * scene.friction.coefficient * scene.friction.normal_force_N;
  return scene;
}

/// The closed loop of a plant whose natural frequency is the given part of the carrier's.
inline scene::Scene with_natural_frequency(double part, double damping_ratio = 0.0) {
  scene::Scene scene = table_1_closed_loop();
  scene::Plant& plant = scene.plant;
  const double omega = 2.0 * pi * carrier_Hz;
  plant.stiffness_N_per_m = plant.mass_kg * part * part * omega * omega;
  plant.damping_N_s_per_m = 2.0 * damping_ratio * plant.mass_kg * part * omega;
  return scene;
}

}  // namespace sonoglide::tests
