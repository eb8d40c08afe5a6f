/// Which circuit a sweep asks for.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host_sim/studies/identify/impedance/circuit_fit.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

/// The most modes of a circuit.
inline constexpr int most_modes = 4;

/// A further mode is taken where an F test on the whitened residuals would see it by chance in fewer
/// sweeps than this share; each reading counts as a place where it was looked for.
inline constexpr double mode_significance = 1e-2;

/// The same for the loss tangent in magnitudes alone.
inline constexpr double loss_significance = 1e-3;

struct Selection {
  CircuitFit fit;                     ///< of the readings that are left
  Sweep sweep;                        ///< them
  std::vector<std::size_t> left_out;  ///< readings that stand apart from those beside them
};

/// The circuit of the sweep: clamped capacitance and as many modes as the F test takes. With
/// phase, the loss tangent is always fitted: to leave out a loss that the sweep does not rule out
/// would make resistance and quality factor too sure. The first mode is the one of the largest
/// conductance.
///
/// The covariance allows for correlation along the sweep (allow_for_correlation) and for a further
/// mode that is likely but not certain, by how likely it is.
///
/// Readings that alone stand 8 robust standard deviations off the middle of their neighbours'
/// residuals are left out.
/// @throws loop::ComputationError  no resonance is seen, it is outside the sweep, or the fit ends at
///         a bound or does not converge
Selection select_circuit(const Sweep& sweep);

}  // namespace sonoglide::identify::impedance
