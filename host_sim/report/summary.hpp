/// What a run came to, as summary.json.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "host_sim/loop/run.hpp"
#include "host_sim/report/run_findings.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::report {

/// Every number that a script may want, with the scene echoed in full; a figure that is not defined
/// for the scene is null.
nlohmann::ordered_json summary(const scene::Scene& scene, const loop::RunResult& result,
                               const RunFindings& findings);

/// The same as text, valid UTF-8 whatever the names in it.
std::string summary_text(const scene::Scene& scene, const loop::RunResult& result,
                         const RunFindings& findings);

}  // namespace sonoglide::report
