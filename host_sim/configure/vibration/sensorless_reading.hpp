/// What a force sensor shows of the vibration through the friction.
#pragma once

#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/configure/vibration/friction_response.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// What is the same for every frequency in the table.
struct FrictionReading {
  double speed = 0.0;   ///< fastest |Vt|, per unit
  double lambda = 0.0;  ///< Kt Vt/(ω Fc); infinite for Coulomb friction
  double sign = 1.0;    ///< of the vibration in the velocity along the sliding
  double noise = 0.0;   ///< of a lag-compensated ratio, rms
  double model_lift =
      0.0;  ///< by how much the compensation of the lag lifts what the model has wrong
  ReadingChain chain;

  VibratedContact contact(double ratio, double phase) const {
    return {ratio, lambda / ratio, phase};
  }
};

/// @param velocity_m_per_s  a velocity of 1, per unit
FrictionReading friction_reading(const scene::Scene& scene, const NominalPlant& plant,
                                 double velocity_m_per_s);

/// Rms of a reading, per sliding velocity.
double noise_of(double ratio, const FrictionReading& reading);

bool slides_backwards(const scene::Sliding& sliding);

}  // namespace sonoglide::configure
