/// The files and the printed table that a comparison leaves behind.
#pragma once

#include <filesystem>
#include <string>

#include "host_sim/studies/arithmetic/comparison.hpp"

namespace sonoglide::arithmetic {

/// Writes arithmetic.csv, targets.csv and arithmetic.svg; all or none.
/// @throws report::OutputError, process::ProcessError
void write(const std::filesystem::path& out, const scene::Scene& scene,
           const Comparison& comparison);

/// The images as a table, and where the picture is.
std::string text(const Comparison& comparison, const std::filesystem::path& out);

}  // namespace sonoglide::arithmetic
