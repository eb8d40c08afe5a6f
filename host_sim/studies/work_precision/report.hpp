/// The files and the few printed lines that a comparison leaves behind.
#pragma once

#include <filesystem>
#include <string>

#include "host_sim/scene/scene.hpp"
#include "host_sim/studies/work_precision/comparison.hpp"

namespace sonoglide::work_precision {

/// Writes work_precision.csv, work_precision.svg and report.html; all or none.
/// @throws report::OutputError, process::ProcessError
void write(const std::filesystem::path& out, const scene::Scene& scene,
           const Comparison& comparison);

/// The result in a few lines, and where the report is.
std::string text(const Comparison& comparison, const std::filesystem::path& out);

}  // namespace sonoglide::work_precision
