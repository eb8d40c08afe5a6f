/// The files and the few printed lines that a comparison leaves behind.
#pragma once

#include <string>

#include "host_sim/output/output_folder.hpp"
#include "host_sim/output/page.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/studies/work_precision/comparison.hpp"

namespace sonoglide::work_precision {

/// One line for each row under a heading line; what was not measured is `nan`.
std::string to_csv(const SolverComparison& comparison);

output::Page page(const scene::Scene& scene, const SolverComparison& comparison);

/// Time for a carrier period against error, both axes logarithmic: one line for each solver through
/// the errors that its settings can be relied on for (see Standing), small points at the errors
/// that they happened to have.
output::Sheet diagram(const scene::Scene& scene, const SolverComparison& comparison);

/// work_precision.csv, work_precision.svg and report.html. @throws process::ProcessError
output::StudyReport report(const scene::Scene& scene, const SolverComparison& comparison);

}  // namespace sonoglide::work_precision
