/// What makes a fit be refused.
#pragma once

#include "host_sim/studies/identify/impedance/circuit_fit.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

/// A residual, root mean square, above which a circuit that fails to describe the sweep is refused.
inline constexpr double most_residual = 0.3;

/// Of a resonance.
inline constexpr double most_quality = 1e7;

/// No start leads to a fit.
///
/// Every refusal names what of the sweep may explain it: the sign of the phase, or that it is of a
/// resistance.
/// @throws loop::ComputationError
[[noreturn]] void refuse_without_fit(const Sweep& sweep);

/// A capacitance alone describes the sweep as well, each reading counted as a place where a resonance was
/// looked for; what neither describes is named as that. @throws loop::ComputationError
void require_resonance(const Sweep& sweep, const CircuitFit& fit);

/// Resonance, quality factor or capacitances of the mode of the largest conductance end at a bound.
/// @throws loop::ComputationError
void require_inside(const Sweep& sweep, const CircuitFit& fit);

/// The residuals are above most_residual, and not by scatter. @throws loop::ComputationError
void require_description(const Sweep& sweep, const CircuitFit& fit);

}  // namespace sonoglide::identify::impedance
