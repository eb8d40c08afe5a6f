#include "host_sim/sweep/velocity_ratio.hpp"

#include "firmware/numeric/turn.hpp"
#include "host_sim/scene/plant_scales.hpp"

namespace sonoglide::sweep {

double peak_vibration_velocity_m_per_s(const scene::Scene& scene) {
  if (!scene.drive) {
    return 0.0;
  }
  const double omega = numeric::two_pi * scene.drive->frequency_Hz;
  return scene.drive->force_amplitude_N * omega /
         scene::dynamic_stiffness_N_per_m(scene.plant, omega);
}

}  // namespace sonoglide::sweep
