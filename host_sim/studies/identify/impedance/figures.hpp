/// What a fitted circuit tells, each figure with its 95 % interval.
#pragma once

#include <optional>
#include <vector>

#include "host_sim/studies/identify/identification.hpp"
#include "host_sim/studies/identify/impedance/circuit_fit.hpp"

namespace sonoglide::identify::impedance {

struct Range {
  double least;
  double most;
};

/// What a scene may have.
inline constexpr Range mass_range_kg = {1e-12, 1e6};
inline constexpr Range force_factor_range_N_per_V = {1e-12, 1e12};

/// What the user knows: one of the two, or neither.
struct MechanicalFact {
  std::optional<double> mass_kg = {};
  std::optional<double> force_factor_N_per_V = {};

  bool known() const { return mass_kg || force_factor_N_per_V; }
};

/// The names of the contract, in its order; then the parts that are fitted, which may be 0 or less;
/// then, with a mechanical fact, m = Nf² L1, Ks = Nf²/C1, c = Nf² R1 and the force factor Nf, of
/// which the known one is exact.
///
/// The first eight and the last four have intervals that are symmetric in their logarithm: those are
/// linear in the fitted vector, but for parallel resonance and coupling, which are linearised.
/// @throws loop::ComputationError  mass or force factor is not in its range
std::vector<Estimate> figures(const CircuitFit& fit, const MechanicalFact& fact = {});

/// Whether the data leave a positive figure open by more than a factor of ten.
bool is_open(const Estimate& estimate);

}  // namespace sonoglide::identify::impedance
