/// What an identification of an impedance leaves behind.
#pragma once

#include <string>

#include "host_sim/output/output_folder.hpp"
#include "host_sim/output/page.hpp"
#include "host_sim/studies/identify/impedance/study.hpp"

namespace sonoglide::identify::impedance {

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
