/// Mass, spring and damping behind the motional branch, once one mechanical fact is known.
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

/// What the user knows: one of the two.
struct MechanicalFact {
  std::optional<double> mass_kg;
  std::optional<double> force_factor_N_per_V;

  bool known() const { return mass_kg || force_factor_N_per_V; }
};

/// m = Nf² L1, Ks = Nf²/C1, c = Nf² R1: mass, stiffness, damping and force factor, each with its
/// interval; the known one is exact.
/// @throws loop::ComputationError  mass or force factor is not in its range
std::vector<Estimate> mechanical_figures(const CircuitFit& fit, const MechanicalFact& fact);

}  // namespace sonoglide::identify::impedance
