#include "host_sim/cli/commands.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "host_sim/cli/cluster_options.hpp"
#include "host_sim/cli/options.hpp"
#include "host_sim/cli/run_watch.hpp"
#include "host_sim/long_work/collection.hpp"
#include "host_sim/loop/step_forecast.hpp"
#include "host_sim/studies/robust/report.hpp"
#include "host_sim/studies/robust/robust.hpp"

namespace sonoglide::cli {
namespace {

struct RobustOptions {
  SceneOptions scene;
  std::string out;  ///< empty: out/<scene name>_robust
  robust::Counts counts;
  ClusterOptions cluster;
  unsigned threads = 0;  ///< 0: one for each core
  bool quiet = false;
};

std::string text(double value, const robust::Figure& figure) {
  return std::isnan(value) ? figure.undefined : fmt::format("{:.3g}", value);
}

/// Of each figure its quantiles over the samples, and what the worst plant has.
std::string figure_lines(const robust::Study& study) {
  constexpr const char* line = "{:>15} {:>9} {:>9} {:>9} {:>9} {:>12}\n";
  std::string lines = fmt::format(line, "", "median", "95 %", "99 %", "worst", "worst plant");
  for (const robust::Figure& figure : robust::figures()) {
    const robust::Quantiles found = robust::quantiles(robust::values_of(study, figure));
    lines += fmt::format(line, figure.key, text(found.median, figure), text(found.p95, figure),
                         text(found.p99, figure), text(found.worst, figure),
                         text(study.worst.row.*figure.value, figure));
  }
  return lines;
}

std::string name_line(const char* title, const std::vector<std::string>& names) {
  return names.empty() ? std::string() : fmt::format("  {}: {}\n", title, fmt::join(names, ", "));
}

std::string worst_lines(const robust::Task& task, const robust::WorstPlant& worst) {
  std::string lines = fmt::format("worst plant, found by {}:\n", worst.found_by);
  for (std::size_t i = 0; i < worst.factors.size(); ++i) {
    lines += fmt::format("  {} = {:.6g}\n", task.tolerances()[i].key, worst.factors[i]);
  }
  lines += name_line("limits", robust::limit_names(worst.row));
  lines += name_line("faults", robust::fault_names(worst.row));
  return worst.row.ok() ? lines : lines + fmt::format("  no result: {}\n", worst.row.status);
}

std::string text(const robust::Task& task, const robust::Outcome& outcome,
                 const std::filesystem::path& out) {
  const robust::Study& study = outcome.study;
  const std::size_t runs = study.samples.size() + study.search.size();
  const std::size_t computed = runs - std::min(runs, outcome.found_finished);
  std::string lines =
      fmt::format("{} and {} of the search", robust::counted(study.samples.size(), "plant"),
                  robust::counted(study.search.size(), "run"));
  if (outcome.found_finished > 0) {
    lines += fmt::format(", {} of them finished before", outcome.found_finished);
  }
  lines += fmt::format("\n{} in {:.3g} s, {:.3g} loops/s\n", robust::counted(computed, "loop"),
                       outcome.wall_s, static_cast<double>(computed) / outcome.wall_s);
  const std::size_t failures = study.failures();
  lines +=
      fmt::format("{} failed: probability of failure at most {:.3g} % (at 95 %)\n", failures,
                  100.0 * robust::failure_probability_upper(failures, study.samples.size(), 0.95));
  if (study.search_failures() > 0) {
    lines += fmt::format("the loop fails in {} of the search\n",
                         robust::counted(study.search_failures(), "run"));
  }
  lines += figure_lines(study) + worst_lines(task, study.worst);
  return lines + fmt::format("rows: {}\nworst plant: {}\nreport: {}\n",
                             printable(out / "robust.csv"), printable(out / "worst.toml"),
                             printable(out / "report.html"));
}

robust::Task task_of(const RobustOptions& options) {
  return {scene_file::read_source(options.scene.path), options.scene.overrides, options.counts};
}

std::filesystem::path folder_of(const RobustOptions& options, const robust::Task& task) {
  return output_folder(options.out, task.nominal().name, "_robust");
}

void tell_notes(const RobustOptions& options, const robust::Task& task) {
  if (!options.quiet) {
    print_notes(task.notes());
  }
}

void announce(const RobustOptions& options, const robust::Task& task, std::size_t runs) {
  if (!options.quiet) {
    announce_long_work(static_cast<double>(runs) * loop::expected_steps(task.nominal()));
  }
}

std::string run_whole(const RobustOptions& options) {
  const robust::Task task = task_of(options);
  const std::filesystem::path out = folder_of(options, task);
  tell_changes(task.source(), task.overrides());
  tell_notes(options, task);
  announce(options, task, task.counts().samples + task.counts().search);
  return text(task,
              computed(options.quiet,
                       [&](const long_work::Progress& progress) {
                         return robust::run_robust(task, out, program_version, options.threads,
                                                   progress);
                       }),
              out);
}

std::string run_shard(const RobustOptions& options) {
  const robust::Task task = task_of(options);
  const std::filesystem::path out = folder_of(options, task);
  const long_work::Shard shard = *long_work::parse_shard(options.cluster.shard);
  announce(options, task, shard.range(task.counts().samples).size());
  return shard_text(computed(options.quiet,
                             [&](const long_work::Progress& progress) {
                               return robust::run_shard(task, shard, out, program_version,
                                                        options.threads, progress);
                             }),
                    out / long_work::rows_name(shard));
}

std::string merge(const RobustOptions& options) {
  const std::filesystem::path out = merged_folder(options.cluster, options.out);
  const long_work::Collection found(options.cluster.merge);
  const robust::Task task = robust::task_of(found, program_version);
  tell_changes(task.source(), task.overrides());
  tell_notes(options, task);
  announce(options, task, task.counts().search);
  return text(task,
              computed(options.quiet,
                       [&](const long_work::Progress& progress) {
                         return robust::merge_shards(found, task, out, program_version,
                                                     options.threads, progress);
                       }),
              out);
}

std::string write_robust_job(const RobustOptions& options) {
  const robust::Task task = task_of(options);
  const robust::Counts& counts = task.counts();
  return write_job({"robust",
                    task.source(),
                    task.overrides(),
                    {"--samples", fmt::format("{}", counts.samples), "--search",
                     fmt::format("{}", counts.search), "--seed", fmt::format("{}", counts.seed)},
                    counts.samples,
                    options.cluster.slurm},
                   folder_of(options, task));
}

/// Throws scene_file::SceneError and CLI::ParseError, nothing was written then; long_work::Incomplete,
/// process::FileError.
void robust(const CLI::App& command, const RobustOptions& options) {
  run_divisible(command, options.cluster, {"scene"},
                {[&] { return run_whole(options); }, [&] { return run_shard(options); },
                 [&] { return merge(options); }, [&] { return write_robust_job(options); }},
                options.quiet);
}

template <class Number>
void add_count(CLI::App& command, const char* name, Number& number, const std::string& meaning,
               std::uint64_t least, std::uint64_t most) {
  command.add_option(name, number, fmt::format("{} [{}]", meaning, number))
      ->type_name("N")
      ->check([=](const std::string& text) { return check_whole(text, least, most); });
}

}  // namespace

void add_robust_command(CLI::App& program) {
  const auto options = std::make_shared<RobustOptions>();
  CLI::App* command = program.add_subcommand(
      "robust",
      "Run a closed loop on many plants inside the scene's [tolerance], on all cores, and search "
      "for the worst of them; interrupted, the same command goes on from there");
  add_scene_options(*command, options->scene);
  command->get_option("scene")->required(false);
  robust::Counts& counts = options->counts;
  add_count(*command, "--samples", counts.samples,
            "Plants to draw; a power of two fills the tolerances best", 1, robust::most_samples);
  add_count(*command, "--search", counts.search,
            "Runs that the search for the worst plant may take; 0: no search", 0,
            robust::most_samples);
  add_count(*command, "--seed", counts.seed, "Seed of the draw: the same seed, the same plants", 0,
            static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()));
  add_output_option(*command, options->out,
                    "robust.csv, search.csv, robust.json, worst.toml and report.html [out/<scene "
                    "name>_robust]");
  add_threads_option(*command, options->threads);
  add_cluster_options(*command, options->cluster,
                      {"scene", "--set", "--samples", "--search", "--seed"});
  command->add_flag("--quiet", options->quiet, "No progress bar, no notes, no printed summary");
  command->callback([command, options] { robust(*command, *options); });
}

}  // namespace sonoglide::cli
