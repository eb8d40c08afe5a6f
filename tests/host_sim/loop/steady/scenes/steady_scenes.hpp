/// Closed-loop scenes whose steady motion is looked for.
#pragma once

#include "host_sim/scene/scene.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/common/table_1.hpp"

namespace sonoglide::steady {

using tests::Table1;

/// The paper's Table 1 with 1920 N at most, sliding at 26.72 mm/s.
inline scene::Scene table_1() {
  scene::Scene scene = tests::table_1_closed_loop();
  scene.run.duration_s = 6e-3;
  scene.controller->target_friction_ratio = {{0.0, 0.7}, {1e-3, 0.3}, {2e-3, 0.5}, {3e-3, 0.3}};
  return scene;
}

/// The same with a Coulomb contact.
inline scene::Scene coulomb() {
  scene::Scene scene = table_1();
  scene.friction.law = scene::laws::Coulomb{};
  scene.friction.contact_stiffness_N_per_m = 0.0;
  return scene;
}

/// A friction curve that falls and rises again, on a damped plant.
inline scene::Scene stribeck() {
  scene::Scene scene = coulomb();
  scene.friction.law = scene::laws::Stribeck{0.1, 0.5};
  scene.plant.damping_N_s_per_m = 10.0;
  return scene;
}

/// A contact of each law that needs keys of its own, light enough not to bend the motion.
inline scene::Scene iwan() {
  scene::Scene scene = table_1();
  scene.friction.law = scene::laws::Iwan{4};
  return scene;
}
inline scene::Scene lugre() {
  scene::Scene scene = table_1();
  scene.friction.law = scene::laws::LuGre{0.15, 0.01, 0.0, 0.01};
  return scene;
}
inline scene::Scene transverse() {
  scene::Scene scene = coulomb();
  scene.friction.law = scene::laws::TransverseCoulomb{};
  return scene;
}
/// About to open at 200 mm/s; no gain from a velocity ratio of 1 on.
inline scene::Scene normal() {
  scene::Scene scene = table_1();
  const double opening_m = 0.2 / (tests::two_pi * scene.drive->frequency_Hz);
  const double kz = scene.friction.normal_force_N / opening_m;
  scene.friction.law = scene::laws::NormalCoulomb{kz};
  scene.friction.contact_stiffness_N_per_m = scene.friction.coefficient * kz;
  return scene;
}

/// Table 1's mass on a contact that is stiffer than its spring: the mode of a stuck contact is at 2.04
/// carriers, and the orbits by which the contact begins to slip under a heavy load repel.
inline scene::Scene heavy_contact(double normal_force_N) {
  scene::Scene scene = table_1();
  const double mode = 2.04 * tests::two_pi * scene.drive->frequency_Hz;
  const double stuck_N_per_m = scene.plant.mass_kg * mode * mode;
  scene.plant.stiffness_N_per_m = stuck_N_per_m / 2.4;
  scene.friction.contact_stiffness_N_per_m = stuck_N_per_m * 1.4 / 2.4;
  scene.friction.normal_force_N = normal_force_N;
  scene.sensor.force_full_scale_N = 0.2 * normal_force_N;
  return scene;
}

/// A mass on a belt whose friction falls with the speed, and a mode far below the carrier.
inline scene::Scene falling_lugre() {
  scene::Scene scene;
  scene.plant.mass_kg = 1.0;
  scene.plant.stiffness_N_per_m = 1e4;
  scene.plant.damping_N_s_per_m = 2.0;
  scene.friction.law = scene::laws::LuGre{0.5, 0.05, 0.0, 0.0};
  scene.friction.coefficient = 0.3;
  scene.friction.normal_force_N = 10.0;
  scene.friction.contact_stiffness_N_per_m = 1e6;
  scene.sliding.profile = {{0.0, 0.03}};
  scene.drive.emplace();
  scene.drive->frequency_Hz = 2e3;
  scene.drive->max_force_amplitude_N = 3000.0;
  scene.run.duration_s = 4.0;
  scene.controller.emplace();
  scene.controller->target_friction_ratio = {{0.0, 0.5}, {1.0, 0.97}};
  scene.sensor.force_full_scale_N = 10.0;
  return scene;
}

/// Natural and drive frequency are one; damping, heavy friction, and little force.
inline scene::Scene resonant() {
  scene::Scene scene = table_1();
  const double omega = tests::two_pi * scene.drive->frequency_Hz;
  scene.plant.stiffness_N_per_m = scene.plant.mass_kg * omega * omega;
  scene.plant.damping_N_s_per_m = 200.0;
  scene.friction.normal_force_N = 20.0;
  scene.friction.contact_stiffness_N_per_m = 5e7;
  scene.drive->max_force_amplitude_N = 50.0;
  scene.sensor.force_full_scale_N = 4.0;
  return scene;
}

}  // namespace sonoglide::steady
