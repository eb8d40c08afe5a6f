#include "host_sim/studies/robust/robust.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "host_sim/batch/run_dahl_plants.hpp"
#include "host_sim/output/output_folder.hpp"
#include "host_sim/output/page.hpp"
#include "host_sim/process/ending.hpp"
#include "host_sim/studies/robust/report.hpp"

namespace sonoglide::robust {
namespace {

namespace fs = std::filesystem;

constexpr const char* samples_file = "robust.csv";
constexpr const char* search_file = "search.csv";
constexpr const char* figures_file = "robust.json";
constexpr const char* worst_file = "worst.toml";
constexpr const char* page_file = "report.html";

void write_files(const Task& task, const Study& study, const std::string& page,
                 const fs::path& out) {
  output::OutputFolder folder(out);
  write_samples(folder.open(samples_file), task, study);
  write_search(folder.open(search_file), task, study);
  folder.write(figures_file, to_json(task, study).dump(2) + '\n');
  folder.write(worst_file, task.plant_text(study.worst.factors));
  folder.write(page_file, page);
  folder.commit();
}

/// @param samples  that are known already, from the first on
Outcome run(const Task& task, const fs::path& out, const std::string& program, unsigned threads,
            const std::vector<PlantRow>& samples, const long_work::Progress& progress) {
  const shards::ThreadLimit limit(threads);
  check_samples(task, {samples.size(), task.counts().samples});
  output::create_folder(out, {samples_file, search_file, figures_file, worst_file, page_file});
  // Rows of another arithmetic, which an earlier program had, do not mix with these.
  Solver solver(task, out, fmt::format("{}, {}", program, batch::arithmetic), samples);
  const auto begin = std::chrono::steady_clock::now();
  long_work::Pace pace(progress);
  Outcome outcome{solver.solve(pace), solver.found_finished(), 0.0};
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  outcome.wall_s = wall.count();
  const std::string page = output::to_html(robust_page(task, outcome.study));
  // Files that are written, beside the journal of what they came from, would pass for older ones.
  const process::Undisturbed now;
  write_files(task, outcome.study, page, out);
  solver.remove_journal();
  return outcome;
}

/// The samples of all shards, and what the search and the figures need besides.
shards::Work work_of(const Task& task, const std::string& program, std::uint64_t shards) {
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

std::optional<shards::RecordFacts> facts(std::string_view text) {
  const std::optional<Record> record = parse_record(text);
  return record ? std::optional<shards::RecordFacts>({record->place, !record->row.computed()})
                : std::nullopt;
}

}  // namespace

Outcome run_robust(const Task& task, const fs::path& out, const std::string& program,
                   unsigned threads, const long_work::Progress& progress) {
  return run(task, out, program, threads, {}, progress);
}

shards::ShardSummary run_shard(const Task& task, const shards::Shard& shard, const fs::path& folder,
                               const std::string& program, unsigned threads,
                               const long_work::Progress& progress) {
  const shards::Computation computation = {
      [&task](const shards::PointRange& samples, long_work::Pace&) {
        check_samples(task, samples);
      },
      [&task](const shards::PointRange&, const std::vector<std::uint64_t>& open,
              const shards::Sink& sink) {
        run_samples(task, open, [&](std::size_t first, const std::vector<PlantRow>& rows) {
          std::vector<shards::FinishedPoint> finished;
          for (std::size_t i = 0; i < rows.size(); ++i) {
            const std::size_t sample = open[first + i];
            finished.push_back({sample, record_text({sample, rows[i]})});
          }
          sink(finished);
        });
      },
      facts};
  return shards::run_shard({work_of(task, program, shard.count), shard.number}, computation, folder,
                           threads, progress);
}

Task task_of(const shards::Collection& shards, const std::string& program) {
  shards.require_of("robust", program, batch::arithmetic);
  const shards::Work& work = shards.work();
  return {{work.name + ".toml", work.scene},
          work.overrides,
          {std::stoull(work.options.at(0)), std::stoull(work.options.at(1)),
           std::stoull(work.options.at(2))}};
}

Outcome merge_shards(const shards::Collection& shards, const Task& task, const fs::path& out,
                     const std::string& program, unsigned threads,
                     const long_work::Progress& progress) {
  std::vector<PlantRow> samples;
  shards.for_each_record([&](std::uint64_t sample, const std::string& text) {
    std::optional<Record> record = parse_record(text);
    if (!record || record->place != sample) {
      return false;
    }
    samples.push_back(std::move(record->row));
    return true;
  });
  return run(task, out, program, threads, samples, progress);
}

}  // namespace sonoglide::robust
