/// Identification of a transducer's circuit from a sweep.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/output/page.hpp"
#include "host_sim/output/study_report.hpp"
#include "host_sim/studies/identify/identification.hpp"
#include "host_sim/studies/identify/impedance/circuit_fit.hpp"
#include "host_sim/studies/identify/impedance/selection.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

// What a fitted circuit tells, each figure with its 95 % interval.

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
/// linear in the fitted vector, but for parallel resonance and coupling, which are linearised. Of a fit with
/// alternatives the interval goes between the quantiles of their mixture.
/// @throws loop::ComputationError  mass or force factor is not in its range
std::vector<Estimate> figures(const CircuitFit& fit, const MechanicalFact& fact = {});

/// Whether the data leave a positive figure open by more than a factor of ten.
bool is_open(const Estimate& estimate);

// Sweeps with more readings than a fit has use for.

/// Of a longer sweep one of so many readings is used, and all about the resonance.
inline constexpr std::size_t most_readings = 6000;

/// select_circuit; of a longer sweep first with all readings about its largest conductance, then
/// with all about the resonance that this leads to. A warning says so.
/// @throws loop::ComputationError  see select_circuit
Selection select_of_any_length(const Sweep& sweep);

// What is to be said beside the figures of an identification.

/// Each a sentence or more: what was assumed of the file, and what is wrong with sweep or fit.
std::vector<std::string> warnings_of(const Selection& selected);

/// Each a sentence or more: what the data leave open, and what would tell.
/// @param estimates  the figures of the fit
std::vector<std::string> open_questions(const std::vector<Estimate>& estimates,
                                        const Selection& selected, const MechanicalFact& fact);

struct ImpedanceStudy {
  std::string name;  ///< of the file
  Sweep sweep;       ///< what was fitted
  CircuitFit fit;
  MechanicalFact fact;
  Identification identification;
  std::string scene;  ///< the text of scene.toml; empty where there is none
};

/// @param name  of the file, for the titles
/// @throws loop::ComputationError  see select_circuit
ImpedanceStudy study(const std::string& name, const Sweep& sweep, const MechanicalFact& fact);

// What an identification of an impedance leaves behind.

/// Magnitude and phase with the fit, the admittance circle, the residuals, the figures with their
/// intervals and correlations. @throws process::ProcessError  of the picture
output::Page page(const ImpedanceStudy& study);

/// A closed-loop scene of the transducer at its resonance. What the sweep does not tell, contact,
/// sliding and amplifier, is assumed so that the loop has room, and a comment beside it says so.
/// @pre a mechanical fact is known
std::string scene_toml(const ImpedanceStudy& study);

/// report.html, identify.json, fit.csv and, where a mechanical fact is known, scene.toml.
/// @throws process::ProcessError  of the picture
output::StudyReport report(const ImpedanceStudy& study);

}  // namespace sonoglide::identify::impedance
