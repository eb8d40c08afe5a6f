/// The files and the printed page that an identification of friction leaves behind.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

#include "host_sim/output/page.hpp"
#include "host_sim/studies/identify/friction/comparison.hpp"

namespace sonoglide::identify::friction {

/// identify.json: what every identification tells, of the best law, and `law` and `laws[]`.
nlohmann::ordered_json to_json(const Comparison& comparison);

/// @param name  of the file of readings
output::Page page(const Comparison& comparison, const std::string& name);

/// Writes report.html, identify.json and, where there is one, scene.toml; all or none.
/// @throws output::OutputError
void write(const std::filesystem::path& out, const Comparison& comparison, const std::string& name);

/// The comparison on a page of text, and where the report is.
std::string text(const Comparison& comparison, const std::filesystem::path& out);

/// What is wrong with the best that there is: empty, or why a law fails.
std::string verdict(const Comparison& comparison, const LawFit& fit);

/// A parameter with its interval: `0.41 (0.38 to 0.45)`.
std::string interval_text(const Estimate& estimate);

}  // namespace sonoglide::identify::friction
