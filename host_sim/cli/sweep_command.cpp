#include "host_sim/cli/commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "host_sim/cli/cluster_options.hpp"
#include "host_sim/cli/options.hpp"
#include "host_sim/cli/run_watch.hpp"
#include "host_sim/loop/step_forecast.hpp"
#include "host_sim/studies/sweep/solve.hpp"
#include "host_sim/studies/sweep/sweep.hpp"

namespace sonoglide::cli {
namespace {

struct SweepOptions {
  SceneOptions scene;
  std::string out;  ///< empty: out/<scene name>_sweep
  std::vector<std::string> vary;
  ClusterOptions cluster;
  unsigned threads = 0;  ///< 0: one for each core
  bool quiet = false;
};

std::string failures_text(std::size_t failed) {
  return failed > 0 ? fmt::format("{} points failed: see the column status\n", failed) : "";
}

std::string text(const sweep::Summary& summary, const std::filesystem::path& out) {
  const std::size_t computed = summary.points - summary.found_finished;
  std::string lines = fmt::format("{} points", summary.points);
  if (summary.found_finished > 0) {
    lines += fmt::format(", {} of them finished before", summary.found_finished);
  }
  lines += fmt::format("; {} computed in {:.3g} s, {:.3g} points/s\n", computed, summary.wall_s,
                       static_cast<double>(computed) / summary.wall_s);
  for (const std::string& note : summary.notes) {
    lines += fmt::format("WARNING: {}\n", note);
  }
  return lines + failures_text(summary.failed) +
         fmt::format("rows: {}\nreport: {}\n", printable(out / sweep::table_file),
                     printable(out / sweep::page_file));
}

std::string text(const sweep::MergeSummary& summary, const std::filesystem::path& out) {
  return fmt::format("{} points\n", summary.points) + failures_text(summary.failed) +
         fmt::format("rows: {}\n", printable(out / sweep::table_file)) +
         (summary.drawn
              ? fmt::format("report: {}\n", printable(out / sweep::page_file))
              : fmt::format("no picture and no report: more than {} points\n", sweep::most_points));
}

void announce(const SweepOptions& options, const sweep::Plan& plan,
              const long_work::PointRange& points) {
  constexpr std::uint64_t samples = 8;
  if (!options.quiet) {
    announce_long_work(
        static_cast<double>(points.size()) *
        sweep::mean_over(plan, points, std::min(samples, points.size()), loop::expected_steps));
  }
}

std::string run_whole(const SweepOptions& options) {
  const sweep::Plan plan(scene_file::read_source(options.scene.path), options.scene.overrides,
                         options.vary);
  tell_changes(plan.source(), plan.overrides());
  const std::filesystem::path out = output_folder(options.out, plan.first().name, "_sweep");
  announce(options, plan, plan.all());
  return text(computed(options.quiet,
                       [&](const long_work::Progress& progress) {
                         return sweep::run_sweep(plan, out, program_version, options.threads,
                                                 progress);
                       }),
              out);
}

std::string run_shard(const SweepOptions& options) {
  const sweep::Plan plan(scene_file::read_source(options.scene.path), options.scene.overrides,
                         options.vary, sweep::most_points_in_shards);
  const std::filesystem::path out = output_folder(options.out, plan.first().name, "_sweep");
  const long_work::Shard shard = *long_work::parse_shard(options.cluster.shard);
  announce(options, plan, shard.range(plan.grid().size()));
  return shard_text(computed(options.quiet,
                             [&](const long_work::Progress& progress) {
                               return sweep::run_shard(plan, shard, out, program_version,
                                                       options.threads, progress);
                             }),
                    out / long_work::rows_name(shard));
}

std::string merge(const SweepOptions& options) {
  const std::filesystem::path out = merged_folder(options.cluster, options.out);
  return text(computed(options.quiet,
                       [&](const long_work::Progress& progress) {
                         return sweep::merge_shards(options.cluster.merge, out, program_version,
                                                    progress);
                       }),
              out);
}

std::string write_sweep_job(const SweepOptions& options) {
  const sweep::Plan plan(scene_file::read_source(options.scene.path), options.scene.overrides,
                         options.vary, sweep::most_points_in_shards);
  std::vector<std::string> words;
  for (const std::string& vary : plan.vary()) {
    words.insert(words.end(), {"--vary", vary});
  }
  return write_job(
      {"sweep", plan.source(), plan.overrides(), words, plan.grid().size(), options.cluster.slurm},
      output_folder(options.out, plan.first().name, "_sweep"));
}

/// Throws scene_file::SceneError and CLI::ParseError, nothing was written then; long_work::Incomplete,
/// process::FileError, process::ProcessError.
void sweep(const CLI::App& command, const SweepOptions& options) {
  run_divisible(command, options.cluster, {"scene", "--vary"},
                {[&] { return run_whole(options); }, [&] { return run_shard(options); },
                 [&] { return merge(options); }, [&] { return write_sweep_job(options); }},
                options.quiet);
}

}  // namespace

void add_sweep_command(CLI::App& program) {
  const auto options = std::make_shared<SweepOptions>();
  CLI::App* command = program.add_subcommand(
      "sweep",
      "Run a scene for every combination of the values of some keys, on all cores; "
      "interrupted, the same command goes on from there");
  add_scene_options(*command, options->scene);
  command->get_option("scene")->required(false);
  command
      ->add_option("--vary", options->vary,
                   "A key and its values, evenly spaced or, with :log, by equal factors, e.g. "
                   "friction.contact_stiffness_N_per_m=1e4:1e6:32:log, of one value FROM is TO; or "
                   "KEY=A,B,C, words or numbers, e.g. friction.law=dahl,coulomb: a key that only "
                   "some of the laws use may stay in the scene, the others ignore it; repeatable, "
                   "the first key changes slowest. velocity_ratio is the sliding velocity over the "
                   "peak vibration velocity of the steady state without friction, "
                   "Fe w / |Ks - m w^2 + i c w|")
      ->type_name("KEY=FROM:TO:COUNT[:log]|KEY=A,B,...")
      ->allow_extra_args(false);
  add_output_option(*command, options->out,
                    "sweep.csv, sweep.svg (one or two keys) and report.html [out/<scene "
                    "name>_sweep; of --merge the folder of the shards]");
  add_threads_option(*command, options->threads);
  add_cluster_options(*command, options->cluster, {"scene", "--set", "--vary", "--threads"});
  command->add_flag("--quiet", options->quiet, "No progress bar and no printed summary");
  command->callback([command, options] { sweep(*command, *options); });
}

}  // namespace sonoglide::cli
