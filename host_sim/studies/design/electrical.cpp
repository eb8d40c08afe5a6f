#include "host_sim/studies/design/study.hpp"

#include <cmath>

#include "host_sim/loop/steady/requirement.hpp"

namespace sonoglide::design {
namespace {

/// Cm/C0 times the stiffness: Nf²/C0.
double stiffening_N_per_m(const scene::Transducer& transducer) {
  return transducer.force_factor_N_per_V * transducer.force_factor_N_per_V /
         transducer.clamped_capacitance_F;
}

}  // namespace

double coupling_square(const scene::Scene& scene) {
  const double stiffening = stiffening_N_per_m(*scene.transducer);
  return std::isfinite(stiffening) ? stiffening / (scene.plant.stiffness_N_per_m + stiffening)
                                   : 1.0;
}

double parallel_resonance_Hz(const scene::Scene& scene) {
  return scene::natural_Hz(scene.plant.stiffness_N_per_m + stiffening_N_per_m(*scene.transducer),
                           scene.plant.mass_kg);
}

double clamped_power_VA(const scene::Scene& scene, double voltage_V) {
  return 0.5 * voltage_V * voltage_V *
         std::abs(loop::clamped_admittance_S(*scene.transducer, scene.drive->rate_rad_per_s()));
}

double matching_inductance_H(const scene::Scene& scene, const loop::ElectricalFigures& figures) {
  return figures.reactive_power_var < 0.0
             ? -figures.voltage_peak_V * figures.voltage_peak_V /
                   (2.0 * scene.drive->rate_rad_per_s() * figures.reactive_power_var)
             : steady::undefined;
}

ResonantSpring on_resonance(const scene::Scene& scene, const steady::Requirement& requirement) {
  scene::Scene resonant = scene;
  const double omega = scene.drive->rate_rad_per_s();
  resonant.plant.stiffness_N_per_m = scene.plant.mass_kg * omega * omega;
  return {resonant.plant.stiffness_N_per_m,
          steady::require_ratio(resonant, requirement.sliding_m_per_s, requirement.ratio)};
}

}  // namespace sonoglide::design
