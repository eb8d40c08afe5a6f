/// The files and the printed page that a design leaves behind.
#pragma once

#include <filesystem>
#include <string>

#include "host_sim/studies/design/study.hpp"

namespace sonoglide::design {

/// Writes report.html, design.json, design.csv and detuning.csv; all or none.
/// @throws report::OutputError, process::ProcessError
void write(const std::filesystem::path& out, const Study& study);

/// The design on a page of text, and where the report is.
std::string text(const Study& study, const std::filesystem::path& out);

}  // namespace sonoglide::design
