/// What a sensor's readings leave unknown.
#pragma once

#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// Rms of what the vibration converters' codes leave out; 0 of ideal ones.
double vibration_rounding_m_per_s(const scene::Sensor& sensor, double full_scale_m_per_s);

/// Rms of noise and rounding of a vibration sample, in phase and in quadrature alike.
double vibration_noise_m_per_s(const scene::Sensor& sensor, double full_scale_m_per_s);

}  // namespace sonoglide::configure
