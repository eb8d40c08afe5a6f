/// The drive that a friction ratio takes at a sliding speed.
#pragma once

#include <string>

#include "host_sim/scene/scene.hpp"
#include "host_sim/studies/design/steady_motion.hpp"

namespace sonoglide::design {

/// What stands between a ratio and the drive.
enum class Obstacle {
  none,
  undriven,      ///< the contact has the ratio without vibration
  actuator,      ///< the force is more than the drive has
  amplitude,     ///< no vibration makes the ratio so low
  contact_lost,  ///< none that leaves a contact closed that vibrates normally
  no_orbit,      ///< no steady vibration has been found
};

const char* name(Obstacle limit);

/// What is not defined is NaN: the motion where the limit is none but actuator and none.
struct Requirement {
  double sliding_m_per_s = 0.0;
  double ratio = 0.0;
  Obstacle limit = Obstacle::none;
  std::string reason;     ///< of no_orbit
  bool any_orbit = true;  ///< false: under no force that was tried is there one
  SteadyMotion motion;    ///< at the smallest force that gives the ratio
  double closed_form_force_N =
      undefined;  ///< by the closed form, with which the vibration is a sine
  double closed_form_error =
      undefined;  ///< of the ratio: what that force really gives, less the ratio
  double reachable_ratio =
      undefined;  ///< the nearest that the drive can hold at this speed; NaN with no_orbit
};

/// By the closed form's inverse, put right by a root of the ratio on the steady orbit. The search
/// goes on over forces whose orbit repels, and over those under which there is none.
/// Error: force 1e-9 of itself where friction hardly bends the motion.
///
/// @param sliding_m_per_s  > 0
/// @param ratio            in (0, 1]
Requirement require_ratio(const scene::Scene& scene, double sliding_m_per_s, double ratio);

/// Fastest sliding at which the whole drive holds a ratio [m/s]; NaN where none is found.
double fastest_sliding_m_per_s(const scene::Scene& scene, double ratio);

}  // namespace sonoglide::design
