#include "host_sim/sweep/velocity_ratio.hpp"

#include <cmath>

namespace sonoglide::sweep {

double peak_vibration_velocity_m_per_s(const scene::Scene& scene) {
  if (!scene.drive) {
    return 0.0;
  }
  constexpr double two_pi = 6.28318530717958647693;
  const double omega = two_pi * scene.drive->frequency_Hz;
  const double reactance = scene.plant.stiffness_N_per_m - scene.plant.mass_kg * omega * omega;
  const double impedance = std::hypot(reactance, scene.plant.damping_N_s_per_m * omega);
  return scene.drive->force_amplitude_N * omega / impedance;
}

}  // namespace sonoglide::sweep
