/// Scenes drawn over the whole range of what anybody may ask for.
#pragma once

#include <cstdint>

#include "host_sim/scene/scene.hpp"

namespace sonoglide::stability {

inline constexpr int random_scene_periods = 3;

/// Scene number n: the same on every machine, whatever was drawn before.
///
/// Open loop, random_scene_periods carrier periods. Log-uniform, each also 0 now and then:
/// mass 1e-9..1e3 kg (never 0), stiffness 1e-6..1e15 N/m, or that which puts the natural frequency
/// on the drive's; damping 1e-6..1e2 of critical; contact stiffness 1e-3..1e13 N/m (never 0);
/// coefficient 1e-6..10; normal force 1e-9..1e6 N; sliding velocity 1e-9..1e3 m/s, either sign, at
/// times with a linear ramp that keeps its sign; drive frequency 1..1e7 Hz (never 0), amplitude
/// 1e-9..1e9 N, or no drive at all; initial displacement 1e-15..1 m and velocity 1e-9..1e3 m/s,
/// either sign; initial friction force anywhere in +-Fc. Each law and sign convention.
scene::Scene random_scene(std::uint64_t number);

}  // namespace sonoglide::stability
