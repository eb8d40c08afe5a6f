/// The files and the few printed lines that a run leaves behind.
#pragma once

#include <filesystem>
#include <string>

#include "host_sim/loop/run.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::report {

/// Writes summary.json, report.html, periods.csv (one row for each carrier period) and, where the
/// scene records anything, trace.csv; all or none.
/// @throws OutputError  the file system refused
void write_run(const std::filesystem::path& out, const scene::Scene& scene,
               const loop::RunResult& result);

/// The result in a few lines, and where the report is.
std::string run_text(const scene::Scene& scene, const loop::RunResult& result,
                     const std::filesystem::path& out);

}  // namespace sonoglide::report
