/// Which circuit a sweep asks for.
#pragma once

#include <optional>
#include <vector>

#include "host_sim/studies/identify/impedance/circuit_fit.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

/// The most modes of a circuit.
inline constexpr int most_modes = 8;

/// A further mode is taken where an F test on the whitened residuals would see it by chance in fewer
/// sweeps than this share; each reading counts as a place where it was looked for.
inline constexpr double mode_significance = 1e-2;

/// The same for the loss tangent in magnitudes alone.
inline constexpr double loss_significance = 1e-3;

/// The same for resistance and inductance of the leads, in sweeps with phase.
inline constexpr double lead_significance = 1e-3;

/// An inductance in series that a sweep does not show, and what one of 1 µH does to the figures of a
/// circuit without it, relative to them.
struct UnseenInductance {
  double most_H;  ///< up to which the sweep may have one
  double resonance_per_uH;
  double motional_resistance_per_uH;
  double motional_capacitance_per_uH;
  double clamped_capacitance_per_uH;
};

struct Selection {
  CircuitFit fit;                   ///< of the readings that are left
  Sweep sweep;                      ///< them
  std::vector<double> left_out_Hz;  ///< frequencies of readings that stand alone (find_strays)
  /// Of a sweep with phase where no lead is seen: the resistance up to which it may have one, if a
  /// fit with one converges.
  std::optional<double> unseen_lead_ohm = {};
  /// Likewise of a sweep with phase where no inductance of a lead is seen.
  std::optional<UnseenInductance> unseen_inductance = {};
  /// Where the circuit has the most modes and yet another one is seen: the resonance of that.
  std::optional<double> mode_too_many_Hz = {};
};

/// The circuit of the sweep: clamped capacitance, as many modes as the F test takes and, in sweeps
/// with phase, the lead that it takes: resistance, inductance or both. With phase, the loss tangent is always fitted: to leave out a
/// loss that the sweep does not rule out would make resistance and quality factor too sure. The
/// first mode is the one of the largest conductance.
///
/// The covariance allows for correlation along the sweep (allow_for_correlation), for a further mode
/// and a lead that are likely but not certain, by how likely they are, and for misfit
/// (allow_for_misfit). It does not allow for an inductance that is not seen: few sweeps tell one, and
/// the intervals would be those of a circuit that may have any. Strays (find_strays) are left out. Where phases scatter more than magnitudes,
/// the residuals are logarithms (with_logarithmic_residuals).
/// @throws loop::ComputationError  no resonance is seen, it is outside the sweep, or the fit ends at
///         a bound or does not converge
Selection select_circuit(const Sweep& sweep);

}  // namespace sonoglide::identify::impedance
