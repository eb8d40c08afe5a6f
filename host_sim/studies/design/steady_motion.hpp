/// The plant on its steady orbit under one drive force.
#pragma once

#include <limits>
#include <optional>

#include "host_sim/loop/electrical.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::design {

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

}  // namespace sonoglide::design
