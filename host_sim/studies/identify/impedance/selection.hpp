/// Which circuit a sweep asks for.
#pragma once

#include <optional>
#include <vector>

#include "host_sim/studies/identify/impedance/circuit_fit.hpp"
#include "host_sim/studies/identify/impedance/start_values.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

/// The most modes of a circuit.
inline constexpr int most_modes = 8;

/// A further mode is taken where an F test on the whitened residuals would see it by chance in fewer
/// sweeps than this share; each reading counts as a place where it was looked for.
inline constexpr double mode_significance = 1e-2;

/// The same for every other part of a circuit.
inline constexpr double part_significance = 1e-3;

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
  double weight;  ///< its share of the intervals
};

struct Selection {
  CircuitFit fit;                   ///< of the readings that are left
  Sweep sweep;                      ///< them
  std::vector<double> left_out_Hz;  ///< frequencies of readings that stand alone (find_strays)
  /// Where a lead or a rotation of the phase is seen: the others that may be it.
  std::vector<Rival> rivals = {};
  std::vector<Unseen> unseen = {};
};

/// The best plausible fit with a part more, from where it is 0, or of a mode more; none where its
/// linearisation takes less than gain_to_fit.
std::optional<CircuitFit> with_part(const Sweep& sweep, const CircuitFit& fit, Part part);
std::optional<CircuitFit> with_another_mode(const Sweep& sweep, const CircuitFit& fit, Place place);

/// The circuit of the sweep: clamped capacitance, one mode, and of the rest what F tests see: further
/// modes that are apart, in the sweep or beside it; a lean of the mode; with phase, resistance and
/// inductance of leads and a rotation of every phase; without, the loss tangent. With phase the loss tangent is always fitted, and the rotation unless a
/// lead is seen, which looks like it: to leave out what the sweep does not rule out would make the
/// figures too sure. The first mode is the one of the largest conductance.
///
/// Parts are added one after another, the one that takes away most, as if all noise were white; then
/// each that is not seen beside correlated noise is taken out again: several that are left out hide
/// each other and look like noise that hangs together.
///
/// The covariance allows for correlation along the sweep, for circuits that are about as likely, and
/// for misfit (uncertainty.hpp). Strays (find_strays) are left out. Where phases scatter more than
/// magnitudes, the residuals are logarithms.
/// @throws loop::ComputationError  no resonance is seen, it is outside the sweep, or the fit ends at
///         a bound or does not converge
Selection select_circuit(const Sweep& sweep);

}  // namespace sonoglide::identify::impedance
