/// LuGre friction as the tests of scenes vary it.
#pragma once

#include "host_sim/scene/laws/lugre.hpp"

namespace sonoglide::tests {

/// Without damping of its own and without viscous friction.
inline scene::laws::LuGre bare_lugre(double static_coefficient, double stribeck_velocity_m_per_s) {
  scene::laws::LuGre law;
  law.static_coefficient = static_coefficient;
  law.stribeck_velocity_m_per_s = stribeck_velocity_m_per_s;
  return law;
}

/// With damping and viscous friction; halfway down to the sliding coefficient at 17 mm/s.
inline scene::laws::LuGre damped_lugre(double static_coefficient) {
  scene::laws::LuGre law = bare_lugre(static_coefficient, 0.02);
  law.bristle_damping_N_s_per_m = 0.01;
  law.viscous_friction_N_s_per_m = 0.02;
  return law;
}

}  // namespace sonoglide::tests
