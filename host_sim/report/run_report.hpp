/// The files and the few printed lines that a run leaves behind.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

#include "host_sim/loop/run.hpp"
#include "host_sim/output/page.hpp"
#include "host_sim/process/output_folder.hpp"
#include "host_sim/report/run_csv.hpp"
#include "host_sim/report/run_findings.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::report {

output::Page run_page(const configure::Experiment& experiment, const loop::RunResult& result,
                      const RunFindings& findings);

/// Every number that a script may want, with the scene echoed in full; a figure that is not defined
/// for the scene is null.
nlohmann::ordered_json summary(const configure::Experiment& experiment,
                               const loop::RunResult& result, const RunFindings& findings);

/// The same as text, valid UTF-8 whatever the names in it.
std::string summary_text(const configure::Experiment& experiment, const loop::RunResult& result,
                         const RunFindings& findings);

/// The output of one run: summary.json, report.html and, where the scene records anything,
/// trace.csv and periods.csv (one row for each carrier period); all or none.
class RunReport {
 public:
  /// @param experiment  outlives this
  /// @throws process::FileError  nothing can be written there; found out before anything is computed
  RunReport(const std::filesystem::path& out, const configure::Experiment& experiment);

  /// Watches the run: the tables are written as it goes. This outlives the run.
  void join(loop::Watch& watch);

  /// Writes the rest and puts everything in place; to be called once, after the run.
  /// @throws process::FileError  the file system refused; nothing has been changed then
  void finish(const loop::RunResult& result);

  const RunFindings& findings() const { return findings_; }

 private:
  const configure::Experiment& experiment_;
  process::OutputFolder folder_;
  RunFindings findings_;
  std::optional<PeriodsCsv> periods_;
  std::optional<TraceCsv> trace_;
};

/// The result in a few lines.
std::string run_text(const scene::Scene& scene, const loop::RunResult& result,
                     const RunFindings& findings);

}  // namespace sonoglide::report
