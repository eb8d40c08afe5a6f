/// Which circuit a sweep asks for.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "host_sim/studies/identify/impedance/circuit_fit.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

// Fits of circuits that differ from a fit's by a part or a mode.

/// The most modes of a circuit.
inline constexpr int most_modes = 8;

/// With one part or mode more, as far as plausible: lean; with phase, lead, delay and rotation; without,
/// loss tangent. What takes less than 4 from −2 ln likelihood by its linearisation is left out, unless the
/// fit does not describe the sweep; not so a lean, which has minima on either side of none.
std::vector<CircuitFit> larger_fits(const Sweep& sweep, const CircuitFit& fit);

/// With one part or mode less. A loss tangent is always fitted to phases, and a rotation where neither a
/// lead nor a delay is and the circuit describes the sweep: to leave out what the sweep does not rule out
/// would make the figures too sure.
std::vector<CircuitFit> smaller_fits(const Sweep& sweep, const CircuitFit& fit);

/// With these of rotation, delay, resistance and inductance of leads, and without the others; none where
/// the fit has them, is not plausible with them, or the sweep does not determine the delay beside the others.
/// @pre the sweep has phase
std::optional<CircuitFit> turned_fit(const Sweep& sweep, const CircuitFit& fit,
                                     const std::vector<Part>& turning);

/// With every other choice of rotation, delay and lead but none of them: they look like each other.
/// Beside a loss tangent, G and Δ of the mode, a resistance Rs is, to first order, a delay of −C0 Rs with a
/// rotation of −ω C0 Rs. @pre the sweep has phase
std::vector<CircuitFit> turned_fits(const Sweep& sweep, const CircuitFit& fit);

// What the parts of a circuit can be.

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
/// up to 15 degrees, and by a delay as far at the resonance; a lean of up to 3 band widths; in magnitudes alone a loss above 0; further modes
/// apart from the others, in the sweep, up to twice as wide as it and with two readings in the band, or,
/// of sweeps with phase, up to two by up to half of its span beside it, at most ten times the first and
/// of up to four times its quality factor or a quarter.
bool is_plausible(const Sweep& sweep, const CircuitFit& fit);

// Circuits to begin a fit from, out of the data alone.

struct Start {
  double misfit = 0.0;  ///< a sum of squares; of a further mode less what it takes away
  Circuit circuit;
};

/// Circuits of one mode that come near the sweep, the best first; at most `most`.
///
/// Places are the readings with the largest local maxima of G/ω, of magnitudes alone of |Y|/ω, and
/// the middles beside them; bandwidths are tried from a third of the frequency down to 1/300 000 of
/// it. Capacitance C, loss and conductance G follow by linear least squares: of Y, or of magnitudes
/// alone of |Y|², which is linear in C², C G and G².
std::vector<Start> start_circuits(const Sweep& sweep, std::size_t most);

/// A fit's circuit with a further mode behind the others that the residuals ask for most, at most
/// `most`, the best first. Tried are places all over the sweep and where residuals are largest, with
/// bandwidths of a few readings and more; and of sweeps with phase places just outside, with the
/// quality of the first mode. Each by what of the residuals it takes away that a change of the circuit
/// does not; those that take less than `least` from −2 ln likelihood are none.
std::vector<Start> starts_with_another_mode(const Sweep& sweep, const CircuitFit& fit, double least,
                                            std::size_t most);

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
  /// Where a lead, a delay or a rotation of the phase is seen: the others that may be it.
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
/// explains half is fitted in any case. With phase there is a rotation of the phase, unless a lead or a
/// delay is seen or the circuit does not describe the sweep. The first mode is the one of the largest conductance.
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

// What a selection of a circuit leaves uncertain.

/// Whether a part is further from 0 than chance explains.
bool sees(const CircuitFit& fit, Part part);

/// Whether there is a lead or a delay, or a rotation is seen.
bool sees_turned_phase(const CircuitFit& fit);

/// Makes the fit's covariance allow for what the noise may be (average_over_noise), for the other circuits
/// that may be the right one, and for misfit; names those that may be a lead, a delay or a rotation that is
/// seen, and the parts that may be there unseen.
///
/// Averages the covariance over the other circuits (a further mode, a lean, other leads), each with its own
/// and the square of the step to it, weighted by its likelihood less a penalty: Schwarz's, ln n for each
/// parameter; two thirds of it for a further mode and for rivals, with which the intervals hold beside
/// modes too weak to be seen and where two parts turn the phase; and 1 for a resistance of leads in place of
/// a rotation that is not seen, since leads are always there. Rivals may be far from the fit: the intervals
/// are those of the mixture of them (CircuitFit::alternatives), not of the averaged covariance.
/// Source: Kass and Raftery, Journal of the American Statistical Association 90 (1995).
///
/// Where the circuit does not describe the sweep, as if as much of the misfit lay along each
/// parameter's direction as along any other that is as wide: (Jᵀ J)⁻¹ S/p is added, S the misfit's sum of
/// squares and p the number of parameters.
void allow_for_what_is_not_certain(Selection& selected);

}  // namespace sonoglide::identify::impedance
