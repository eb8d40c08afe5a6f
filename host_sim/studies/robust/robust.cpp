#include "host_sim/studies/robust/robust.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "host_sim/output/page.hpp"
#include "host_sim/process/output_folder.hpp"
#include "host_sim/process/thread_limit.hpp"
#include "host_sim/runs/batch/run_dahl_plants.hpp"
#include "host_sim/runs/run_many.hpp"
#include "host_sim/studies/robust/report.hpp"

namespace sonoglide::robust {
namespace {

namespace fs = std::filesystem;

constexpr const char* samples_file = "robust.csv";
constexpr const char* search_file = "search.csv";
constexpr const char* figures_file = "robust.json";
constexpr const char* worst_file = "worst.toml";
constexpr const char* page_file = "report.html";

/// @param then  what belongs to it: files that are written, beside the journal of what they came from,
///              would pass for older ones
void write_files(const Task& task, const Study& study, const fs::path& out,
                 const std::function<void()>& then) {
  const std::string page = output::to_html(robust_page(task, study));
  process::OutputFolder folder(out);
  write_samples(folder.open(samples_file), task, study);
  write_search(folder.open(search_file), task, study);
  folder.write(figures_file, to_json(task, study).dump(2) + '\n');
  folder.write(worst_file, task.plant_text(study.worst.factors));
  folder.write(page_file, page);
  folder.commit(then);
}

/// @param samples  that are known already, from the first on
Outcome run(const Task& task, const fs::path& out, const std::string& program, unsigned threads,
            std::vector<PlantRow> samples, const long_work::Progress& progress) {
  const process::ThreadLimit limit(threads);
  check_samples(task, {samples.size(), task.counts().samples});
  process::create_folder(out, {samples_file, search_file, figures_file, worst_file, page_file});
  // Rows of another arithmetic, which an earlier program had, do not mix with these.
  Solver solver(task, out, fmt::format("{}, {}", program, batch::arithmetic), std::move(samples));
  const double begin_s = long_work::steady_time_s();
  const std::size_t found_finished = solver.found_finished();
  Outcome outcome{solver.solve(progress), found_finished, 0.0};
  outcome.wall_s = long_work::steady_time_s() - begin_s;
  write_files(task, outcome.study, out, [&solver] { solver.remove_journal(); });
  return outcome;
}

/// The samples of all shards, and what the search and the figures need besides.
long_work::Work work_of(const Task& task, const std::string& program, std::uint64_t shards) {
  const Counts& counts = task.counts();
  return {"robust",
          program,
          batch::arithmetic,
          task.source().name(),
          task.source().text,
          task.overrides(),
          {fmt::format("{}", counts.samples), fmt::format("{}", counts.search),
           fmt::format("{}", counts.seed)},
          counts.samples,
          shards};
}

}  // namespace

Outcome run_robust(const Task& task, const fs::path& out, const std::string& program,
                   unsigned threads, const long_work::Progress& progress) {
  return run(task, out, program, threads, {}, progress);
}

long_work::ShardSummary run_shard(const Task& task, const long_work::Shard& shard,
                                  const fs::path& folder, const std::string& program,
                                  unsigned threads, const long_work::Progress& progress) {
  const process::ThreadLimit limit(threads);
  return long_work::run_shard(
      {work_of(task, program, shard.count), shard.number},
      [&task](const long_work::PointRange& samples, long_work::Pace&) {
        check_samples(task, samples);
      },
      computation_of(task), folder, progress);
}

Task task_of(const long_work::Collection& shards, const std::string& program) {
  shards.require_of("robust", program, batch::arithmetic);
  const long_work::Work& work = shards.work();
  return {{work.name + ".toml", work.scene},
          work.overrides,
          {std::stoull(work.options.at(0)), std::stoull(work.options.at(1)),
           std::stoull(work.options.at(2))}};
}

Outcome merge_shards(const long_work::Collection& shards, const Task& task, const fs::path& out,
                     const std::string& program, unsigned threads,
                     const long_work::Progress& progress) {
  std::vector<PlantRow> samples;
  shards.for_each_record(long_work::rows_to<PlantRow>(
      [&samples](std::size_t, PlantRow row) { samples.push_back(std::move(row)); }));
  return run(task, out, program, threads, std::move(samples), progress);
}

}  // namespace sonoglide::robust
