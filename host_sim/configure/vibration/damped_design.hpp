/// The numbers of a loop that observes the plant's natural mode and damps it.
#pragma once

#include "firmware/control/vibration/mode_table.hpp"
#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/configure/vibration/mode_design.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

struct DampedDesign : ModeDesign {
  control::ModeTable<double> table{};
  double noise = 0.0;  ///< of a vibration sample, converter included, rms
  double audible = 0.0;
  double quiet = 0.0;  ///< mode and change of the amplitude up to which no slope is audible
  double settled = 0.0;
  double missing = 0.0;

  static constexpr bool tells_mismatch() { return true; }
};

/// The range of the vibration sensor.
/// @throws ConfigurationError  full drive vibrates at less than 1/64 of it, or at more than half
double damped_full_scale_m_per_s(const scene::Scene& scene, const NominalPlant& plant);

/// @param full_scale_m_per_s  of the vibration sensor
/// @throws ConfigurationError  a plant without a natural mode
DampedDesign design_damping(const scene::Scene& scene, const NominalPlant& plant,
                            double full_scale_m_per_s);

}  // namespace sonoglide::configure
