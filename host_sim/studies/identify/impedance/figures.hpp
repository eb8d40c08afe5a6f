/// What a fitted circuit tells, each figure with its 95 % interval.
#pragma once

#include <vector>

#include "host_sim/studies/identify/identification.hpp"
#include "host_sim/studies/identify/impedance/circuit_fit.hpp"

namespace sonoglide::identify::impedance {

/// The names of the contract, in its order; then the parts that are fitted.
///
/// The first eight have intervals that are symmetric in their logarithm: those are linear in the
/// fitted vector, but for parallel resonance and coupling, which are linearised.
std::vector<Estimate> figures(const CircuitFit& fit);

/// Whether a figure can be 0 or less: loss, lead, rotation and lean.
bool may_be_0(const Estimate& estimate);

/// Whether the data leave a positive figure open by more than a factor of ten.
bool is_open(const Estimate& estimate);

}  // namespace sonoglide::identify::impedance
