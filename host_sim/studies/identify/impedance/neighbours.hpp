/// Fits of circuits that differ from a fit's by a part or a mode.
#pragma once

#include <vector>

#include "host_sim/studies/identify/impedance/circuit_fit.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

/// The most modes of a circuit.
inline constexpr int most_modes = 8;

/// With one part or mode more, as far as plausible: lean; with phase, lead and rotation; without, loss
/// tangent. What takes less than 4 from −2 ln likelihood by its linearisation is left out, unless the
/// fit does not describe the sweep; not so a lean, which has minima on either side of none.
std::vector<CircuitFit> larger_fits(const Sweep& sweep, const CircuitFit& fit);

/// With one part or mode less. A loss tangent is always fitted to phases, and a rotation where no lead is
/// and the circuit describes the sweep: to leave out what the sweep does not rule out would make the
/// figures too sure.
std::vector<CircuitFit> smaller_fits(const Sweep& sweep, const CircuitFit& fit);

/// With another choice of lead and rotation, which look like each other.
std::vector<CircuitFit> turned_fits(const Sweep& sweep, const CircuitFit& fit);

}  // namespace sonoglide::identify::impedance
