/// Which circuit a sweep asks for.
#pragma once

#include <cstddef>
#include <vector>

#include "host_sim/studies/identify/impedance/circuit_fit.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

// Readings that are errors of a single reading.

/// Readings whose residual, in magnitude or phase, is 8 robust standard deviations off the median of the
/// three readings on either side, while the two next to it are within 4: a run of readings that are off
/// is a mode. The standard deviation is that from reading to reading, of the 31 or the 101 readings
/// around, whichever is larger.
std::vector<std::size_t> find_strays(const CircuitFit& fit);

// What makes a fit be refused.

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

/// A part that a sweep does not show, and what one of 1 does to the figures of a circuit without it.
struct Unseen {
  Part part;
  double most;  ///< up to which the sweep may have one
  /// By how much ln C0, and ln G, ln fs and ln Δ of the first mode are off for each 1 of the part.
  Eigen::Vector4d off;
};

/// Another circuit that describes the sweep about as well.
struct Rival {
  CircuitFit fit;
  double weight = 0.0;  ///< its share of the intervals
};

struct Selection {
  CircuitFit fit;                   ///< of the readings that are left
  Sweep sweep;                      ///< them
  std::vector<double> left_out_Hz;  ///< frequencies of readings that stand alone (find_strays)
  /// Where a lead or a rotation of the phase is seen: the others that may be it.
  std::vector<Rival> rivals = {};
  std::vector<Unseen> unseen = {};
};

/// What −2 ln likelihood a part or a further mode has to take away beside Schwarz's ln n for each
/// parameter to be fitted: strong evidence, odds of 20 to 1, by Kass and Raftery, Journal of the American
/// Statistical Association 90 (1995).
inline constexpr double strong_evidence = 6.0;

/// The circuit of the sweep: clamped capacitance, one mode, with phase the loss tangent, and of the rest
/// (larger_fits) what there is strong evidence for. Where a circuit does not describe the sweep, a part
/// that is no mode has to explain half of the misfit: where none does, each takes a little away; and what
/// explains half is fitted in any case. With phase there is a rotation of the phase, unless a lead is seen
/// or the circuit does not describe the sweep. The first mode is the one of the largest conductance.
///
/// Parts are added one after another, the likeliest first, as if all noise were white; then each is taken
/// out again that is not seen beside correlated noise: several that are left out hide each other and look
/// like noise that hangs together.
///
/// The covariance allows for correlation along the sweep, for circuits that are about as likely, and
/// for misfit (uncertainty.hpp). Strays (find_strays) are left out.
/// @throws loop::ComputationError  no resonance is seen, it is outside the sweep, or the fit ends at
///         a bound or does not converge
Selection select_circuit(const Sweep& sweep);

}  // namespace sonoglide::identify::impedance
