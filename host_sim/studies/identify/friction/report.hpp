/// The files and the printed page that an identification of friction leaves behind.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "host_sim/output/output_folder.hpp"
#include "host_sim/output/page.hpp"
#include "host_sim/studies/identify/friction/comparison.hpp"

namespace sonoglide::identify::friction {

/// identify.json: what every identification tells, of the best law, and `law` and `laws[]`.
nlohmann::ordered_json to_json(const Comparison& comparison);

/// @param name  of the file of readings
output::Page page(const Comparison& comparison, const std::string& name);

/// An open-loop scene of the best law at the middle one of the readings with vibration, whose
/// friction ratio is that of the fit. What no reading tells is assumed, and said so in comments: a
/// mass that friction hardly moves, a spring far below resonance, the friction coefficient, and the
/// friction limit or the carrier where the file does not have them.
std::string scene_text(const Comparison& comparison);

/// report.html, identify.json and, where there is one, scene.toml.
output::StudyReport report(const Comparison& comparison, const std::string& name);

/// What is wrong with the best that there is: empty, or why a law fails.
std::string verdict(const Comparison& comparison, const LawFit& fit);

}  // namespace sonoglide::identify::friction
