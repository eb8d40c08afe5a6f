/// The steady vibration of a scene in open loop, found without waiting for it.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "host_sim/loop/plant/plant_port.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// What a multiplier may exceed 1 by: its differences are taken of a solver's results.
inline constexpr double largest_rounding = 1e-6;

/// The periodic orbit z = P(z), where P takes the state z, which is x, x' and what the contact
/// remembers, over one carrier period.
struct SteadyOrbit {
  PlantState state;            ///< at drive phase 0
  std::vector<double> memory;  ///< of the contact there: see PlantPort::memory
  /// Largest modulus of an eigenvalue of dP/dz: what is left of a small deviation after a carrier
  /// period. 1 where nothing damps the natural mode, as where the contact never reverses: the
  /// motion from another initial state then keeps a free vibration beside the orbit.
  double multiplier;
  std::uint64_t periods;  ///< carrier periods that were solved to find it
  EnergyBalance energy;   ///< of a carrier period on it, without what the undriven slide would meet

  /// Not one that a plant settles on.
  bool repels() const { return multiplier > 1.0 + largest_rounding; }
};

/// Newton's method on P(z) = z, by the scene's own solver; the initial state of the scene is of no
/// consequence unless the orbit cannot be reached from the plant's vibration without a contact.
///
/// Error: state within max(1e-10, solver.tolerance) of the motion's size.
/// @param most_steps  of the solver, for all carrier periods together; the search gives up then
/// @throws ComputationError  no orbit of the drive's period was found, as at the resonance of an
///         undamped plant; a motion of several carrier periods is not looked for
SteadyOrbit find_orbit(const scene::Scene& scene, std::uint64_t most_steps);

/// The same for a plant that is to settle on it.
/// @throws ComputationError  also where it repels, as under the sign convention as printed
SteadyOrbit find_steady_orbit(const scene::Scene& scene,
                              std::uint64_t most_steps = std::numeric_limits<std::uint64_t>::max());

}  // namespace sonoglide::loop
