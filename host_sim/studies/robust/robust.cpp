#include "host_sim/studies/robust/robust.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <chrono>

#include "host_sim/batch/run_dahl_plants.hpp"
#include "host_sim/output/output_folder.hpp"
#include "host_sim/output/page.hpp"
#include "host_sim/process/interruption.hpp"
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

}  // namespace

Outcome run_robust(const Task& task, const fs::path& out, const std::string& program,
                   unsigned threads, const long_work::Progress& progress) {
  const tbb::global_control limit(
      tbb::global_control::max_allowed_parallelism,
      threads > 0 ? threads : static_cast<std::size_t>(tbb::info::default_concurrency()));
  check_samples(task);
  output::create_folder(out, {samples_file, search_file, figures_file, worst_file, page_file});
  // Rows of another arithmetic, which an earlier program had, do not mix with these.
  Solver solver(task, out, fmt::format("{}, {}", program, batch::arithmetic));
  const auto begin = std::chrono::steady_clock::now();
  long_work::Pace pace(progress);
  Outcome outcome{solver.solve(pace), solver.found_finished(), 0.0};
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  outcome.wall_s = wall.count();
  const std::string page = output::to_html(robust_page(task, outcome.study));
  // Interrupted, it is carried through first: it takes a second at most.
  const process::Interruption held;
  write_files(task, outcome.study, page, out);
  solver.remove_journal();
  return outcome;
}

}  // namespace sonoglide::robust
