/// The files and the printed lines that an identification of an impedance leaves behind.
#pragma once

#include <filesystem>
#include <string>

#include "host_sim/output/page.hpp"
#include "host_sim/studies/identify/impedance/study.hpp"

namespace sonoglide::identify::impedance {

/// Measured and fitted admittance in the complex plane, an SVG document.
/// @throws process::ProcessError
std::string draw_circle(const ImpedanceStudy& study);

/// Magnitude and phase with the fit, the admittance circle, the residuals, the figures with their
/// intervals and correlations. @throws process::ProcessError  of the picture
output::Page page(const ImpedanceStudy& study);

/// Frequency, measured and fitted admittance, relative residuals; 17 digits.
std::string fit_csv(const ImpedanceStudy& study);

/// A closed-loop scene of the transducer at its resonance. What the sweep does not tell, contact,
/// sliding and amplifier, is assumed so that the loop has room, and a comment beside it says so.
/// @pre a mechanical fact is known
std::string scene_toml(const ImpedanceStudy& study);

/// Writes report.html, identify.json, fit.csv and, where a mechanical fact is known, scene.toml; all
/// or none. @throws output::OutputError, process::ProcessError
void write(const std::filesystem::path& out, const ImpedanceStudy& study);

/// The figures on a page of text, and where the report is.
std::string text(const ImpedanceStudy& study, const std::filesystem::path& out);

}  // namespace sonoglide::identify::impedance
