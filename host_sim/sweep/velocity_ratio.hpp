/// The sliding velocity that belongs to a velocity ratio.
#pragma once

#include "host_sim/scene/scene.hpp"

namespace sonoglide::sweep {

/// Peak vibration velocity of the steady state without friction, for a constant drive amplitude:
///   v̂ = Fe ω / |Ks − m ω² + i c ω| [m/s];
/// 0 without a drive, infinite or not a number at an undamped resonance.
double peak_vibration_velocity_m_per_s(const scene::Scene& scene);

}  // namespace sonoglide::sweep
