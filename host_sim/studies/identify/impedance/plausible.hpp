/// What the parts of a circuit can be.
#pragma once

#include "host_sim/studies/identify/impedance/circuit_fit.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

/// Whether the resonance of a mode is in the sweep.
bool is_in(const Sweep& sweep, const Mode& mode);

/// Whether a mode is two band widths, of the larger one, off every other of the circuit: nearer ones
/// look like a single peak that is not that of a linear mode. Beside a mode that is too wide for a peak
/// of the sweep and stands for several that are not fitted yet, of the narrower one.
bool is_apart(const Sweep& sweep, const Circuit& circuit, const Mode& mode);

/// The inductance of a cable: at the resonance, its reactance is up to a twentieth of that of the
/// clamped capacitance. A larger one would be a part of its own, and in a narrow sweep it looks like
/// any error of the phase.
double most_inductance_H(const Circuit& circuit);

/// Whether least squares found a minimum whose parts can be what they are named: a lead of resistance
/// from 0 to a quarter of the motional one and of inductance from 0 to most_inductance_H; phases off by
/// up to 15 degrees; a lean of up to 3 band widths; in magnitudes alone a loss above 0; further modes
/// apart from the others, in the sweep, up to twice as wide as it and with two readings in the band, or,
/// of sweeps with phase, up to two by up to half of its span beside it, at most ten times the first and
/// of up to four times its quality factor or a quarter.
bool is_plausible(const Sweep& sweep, const CircuitFit& fit);

}  // namespace sonoglide::identify::impedance
