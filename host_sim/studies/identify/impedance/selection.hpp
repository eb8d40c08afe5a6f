/// Which circuit a sweep asks for.
#pragma once

#include <vector>

#include "host_sim/studies/identify/impedance/circuit_fit.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

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
