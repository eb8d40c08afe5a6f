/// The steady vibration of a scene in open loop, found without waiting for it.
#pragma once

#include <cstdint>
#include <vector>

#include "host_sim/loop/plant_port.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// The periodic orbit z = P(z), where P takes the state z, which is x, x' and what the contact
/// remembers, over one carrier period.
struct SteadyOrbit {
  PlantState state;            ///< at drive phase 0
  std::vector<double> memory;  ///< of the contact there: see PlantPort::memory
  /// Largest modulus of an eigenvalue of dP/dz: what is left of a small deviation after a carrier
  /// period. At most 1 + largest_rounding: an orbit that repels is not one that a plant settles on.
  /// 1 where nothing damps the natural mode, as where the contact never reverses: the motion from
  /// another initial state then keeps a free vibration beside the orbit.
  double multiplier;
  std::uint64_t periods;  ///< carrier periods that were solved to find it
};

/// What a multiplier may exceed 1 by: its differences are taken of a solver's results.
inline constexpr double largest_rounding = 1e-6;

/// Newton's method on P(z) = z, by the scene's own solver; the initial state of the scene is of no
/// consequence unless the orbit cannot be reached from the plant's vibration without a contact.
///
/// Error: state within max(1e-10, solver.tolerance) of the motion's size.
/// @throws ComputationError  no orbit of the drive's period was found, as at the resonance of an
///         undamped plant, or it repels, as under the sign convention as printed; a motion of
///         several carrier periods is not looked for
SteadyOrbit find_steady_orbit(const scene::Scene& scene);

}  // namespace sonoglide::loop
