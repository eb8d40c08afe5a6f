#include "host_sim/report/run_report.hpp"

#include "host_sim/report/run_page.hpp"
#include "host_sim/report/summary.hpp"

namespace sonoglide::report {
namespace {

constexpr const char* summary_file = "summary.json";
constexpr const char* page_file = "report.html";
constexpr const char* trace_file = "trace.csv";
constexpr const char* periods_file = "periods.csv";

CsvFile open(output::OutputFolder& folder, const char* name) {
  return {(folder.target() / name).string(), folder.open(name)};
}

}  // namespace

RunReport::RunReport(const std::filesystem::path& out, const scene::Scene& scene,
                     const std::optional<configure::ControlDesign>& design)
    : scene_(scene),
      folder_(out, {summary_file, page_file, trace_file, periods_file}),
      findings_(scene, design) {
  if (!scene.run.record.empty()) {
    periods_.emplace(open(folder_, periods_file));
    trace_.emplace(open(folder_, trace_file), scene.run.record);
  } else {
    folder_.withdraw(periods_file);
    folder_.withdraw(trace_file);
  }
}

void RunReport::join(loop::Watch& watch) {
  findings_.join(watch);
  if (trace_) {
    watch.periods.push_back(&*periods_);
    watch.samples.push_back({{0.0, scene_.run.duration_s, scene_.run.record_interval_s}, &*trace_});
  }
}

void RunReport::finish(const loop::RunResult& result) {
  folder_.write(summary_file, summary_text(scene_, result, findings_));
  folder_.write(page_file, output::to_html(run_page(scene_, result, findings_)));
  folder_.commit();
}

}  // namespace sonoglide::report
