/// Whether a sweep asks for the larger of two circuits.
#pragma once

#include "host_sim/studies/identify/impedance/circuit_fit.hpp"

namespace sonoglide::identify::impedance {

/// The F test of the larger fit against the smaller one.
/// @return the share of sweeps of the smaller circuit in which the larger one would do as much better
double chance(const CircuitFit& smaller, const CircuitFit& larger);

/// Schwarz's penalty of a fit's parameters, in −2 ln likelihood: ln n each.
double penalty(const CircuitFit& fit);

}  // namespace sonoglide::identify::impedance
