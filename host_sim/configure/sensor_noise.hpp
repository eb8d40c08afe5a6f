/// What a sensor's readings leave unknown.
#pragma once

#include <cmath>

#include "firmware/numeric/float_elementary.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// Rms of what the vibration converters' codes leave out; 0 of ideal ones.
inline double vibration_rounding_m_per_s(const scene::Sensor& sensor, double full_scale_m_per_s) {
  const double code_m_per_s =
      sensor.vibration_bits ? 2.0 * full_scale_m_per_s * std::exp2(-*sensor.vibration_bits) : 0.0;
  return code_m_per_s / numeric::sqrt(12.0);
}

/// Rms of noise and rounding of a vibration sample, in phase and in quadrature alike.
inline double vibration_noise_m_per_s(const scene::Sensor& sensor, double full_scale_m_per_s) {
  const double noise = sensor.vibration_noise_m_per_s;
  const double rounding = vibration_rounding_m_per_s(sensor, full_scale_m_per_s);
  return numeric::sqrt(noise * noise + rounding * rounding);
}

}  // namespace sonoglide::configure
