/// The report page of a run.
#pragma once

#include "host_sim/loop/run.hpp"
#include "host_sim/output/page.hpp"
#include "host_sim/report/run_findings.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::report {

output::Page run_page(const scene::Scene& scene, const loop::RunResult& result,
                      const RunFindings& findings);

}  // namespace sonoglide::report
