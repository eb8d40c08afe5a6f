/// The drive that a friction ratio takes at a sliding speed.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "host_sim/loop/electrical.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::steady {

// The plant on its steady orbit under one drive force.

/// Of a search for an orbit: a hundred times what one takes. Under forces far beyond those that a
/// contact allows for a period may take a million.
inline constexpr std::uint64_t most_steps = 200000;

/// A figure that there is not.
inline constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

/// Means over a carrier period. Powers in W.
struct SteadyMotion {
  double drive_force_N = undefined;  ///< amplitude
  double friction_ratio = undefined;
  double displacement_amplitude_m = undefined;    ///< half of peak to peak
  double velocity_amplitude_m_per_s = undefined;  ///< likewise
  double drive_power_W = undefined;               ///< mean Fe x': what the drive puts in
  double apparent_power_W = undefined;            ///< Fe v̂/2: what drive and mass pass to and fro
  double friction_power_W = undefined;            ///< mean F V: dissipated in the contact
  double undriven_friction_power_W = undefined;   ///< the same at this speed without vibration
  double damping_power_W = undefined;             ///< mean c x'²
  std::optional<loop::ElectricalFigures> electrical = std::nullopt;  ///< with a transducer
};

/// The open loop that a drive of constant amplitude makes of a scene: one carrier period on the
/// steady orbit, whatever the scene's run, solver and initial state.
scene::Scene steady_scene(const scene::Scene& scene, double sliding_m_per_s, double drive_force_N);

/// Mean friction over that of the same speed without vibration.
/// Error: 1e-10, that of the orbit.
/// @throws loop::ComputationError  no steady orbit
double friction_ratio(const scene::Scene& steady_scene);

/// The same on an orbit that may repel: it goes on where the plant does not follow it.
/// @throws loop::ComputationError  no orbit
double orbit_ratio(const scene::Scene& steady_scene);

/// Error: amplitudes 1e-5 of themselves (720 samples of a period), powers as the ratio.
/// @throws loop::ComputationError
SteadyMotion steady_motion(const scene::Scene& steady_scene);

// Friction ratio under a prescribed sinusoidal vibration, by the closed form of the scene's law.

/// Mean friction over the undriven one, as firmware/friction has it for every law; of normal_coulomb
/// while its contact stays closed.
///
/// @param sliding_m_per_s    > 0
/// @param vibration_m_per_s  peak velocity v̂, > 0
double closed_form_ratio(const scene::Scene& scene, double sliding_m_per_s,
                         double vibration_m_per_s);

/// A friction ratio and the least vibration that gives it.
struct RequiredVibration {
  double friction_ratio;
  double velocity_m_per_s;  ///< peak
};

/// The vibration that gives a ratio; friction_ratio differs from the one asked for where no
/// vibration up to 10^6 times the sliding, of normal_coulomb none that leaves the contact closed,
/// gives that: it is the lowest then.
///
/// @param ratio  less than without vibration
RequiredVibration closed_form_vibration(const scene::Scene& scene, double sliding_m_per_s,
                                        double ratio);

/// Drive force that a vibration takes without a contact [N].
double force_N(const scene::Scene& scene, double vibration_m_per_s);

/// What stands between a ratio and the drive.
enum class Obstacle {
  none,
  undriven,          ///< the contact has the ratio without vibration
  actuator,          ///< the force is more than the drive has
  velocity_at_rail,  ///< the sliding is as fast as a controller's velocities reach: it does not drive
  amplitude,         ///< no vibration makes the ratio so low
  contact_lost,      ///< none that leaves a contact closed that vibrates normally
  unstable,          ///< the steady vibration that gives it repels: a small deviation grows
  no_orbit,          ///< no steady vibration has been found
};

const char* name(Obstacle limit);

/// What is not defined is NaN. There is a motion where the limit is none, actuator or
/// velocity_at_rail.
struct Requirement {
  double sliding_m_per_s = 0.0;
  double ratio = 0.0;
  Obstacle limit = Obstacle::none;
  std::string reason;     ///< of unstable and no_orbit
  bool any_orbit = true;  ///< false: under no force that was tried is there one
  SteadyMotion motion;    ///< at the smallest force that gives the ratio
  double closed_form_force_N =
      undefined;  ///< by the closed form, with which the vibration is a sine
  double closed_form_error =
      undefined;  ///< of the ratio: what that force really gives, less the ratio
  double reachable_ratio =
      undefined;  ///< the nearest that the drive can hold at this speed; NaN with the last two
  double unstable_force_N = undefined;  ///< of unstable
};

/// Of the plant, whatever controls it: never velocity_at_rail.
/// By the closed form's inverse, put right by a root of the ratio on the steady orbit. The search
/// goes on over forces whose orbit repels, and over those under which there is none.
/// Error: force 1e-9 of itself where friction hardly bends the motion.
///
/// @param sliding_m_per_s  > 0
/// @param ratio            in (0, 1]
Requirement require_ratio(const scene::Scene& scene, double sliding_m_per_s, double ratio);

/// Fastest sliding at which the whole drive holds a ratio [m/s]; NaN where none is found, and for a law
/// whose friction falls with the velocity: less drive may then hold it at a higher one.
double fastest_sliding_m_per_s(const scene::Scene& scene, double ratio);

}  // namespace sonoglide::steady
