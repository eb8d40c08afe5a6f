#include "host_sim/cli/commands.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "host_sim/cli/options.hpp"
#include "host_sim/cli/progress_bar.hpp"
#include "host_sim/process/printable.hpp"
#include "host_sim/studies/sweep/sweep.hpp"

namespace sonoglide::cli {
namespace {

struct SweepOptions {
  SceneOptions scene;
  std::string out;  ///< empty: out/<scene name>_sweep
  std::vector<std::string> vary;
  unsigned threads = 0;  ///< 0: one for each core
  bool quiet = false;
};

sweep::Summary compute(const sweep::Plan& plan, const std::filesystem::path& out,
                       const SweepOptions& options) {
  ProgressBar bar(stderr, !options.quiet);
  try {
    return sweep::run_sweep(plan, out, "sonoglide " SONOGLIDE_VERSION, options.threads,
                            [&bar](double fraction) { bar.update(fraction); });
  } catch (const sweep::ForeignJournal& error) {
    throw CLI::ValidationError("--out", error.what());
  }
}

std::string text(const sweep::Summary& summary, const std::filesystem::path& out) {
  const std::size_t computed = summary.points - summary.found_finished;
  std::string lines = fmt::format("{} points", summary.points);
  if (summary.found_finished > 0) {
    lines += fmt::format(", {} of them finished before", summary.found_finished);
  }
  lines += fmt::format("; {} computed in {:.3g} s, {:.3g} points/s\n", computed, summary.wall_s,
                       static_cast<double>(computed) / summary.wall_s);
  if (summary.failed > 0) {
    lines += fmt::format("{} points failed: see the column status\n", summary.failed);
  }
  return lines + fmt::format("rows: {}\nreport: {}\n",
                             process::printable((out / "sweep.csv").string()),
                             process::printable((out / "report.html").string()));
}

/// Throws scene_file::SceneError and CLI::ValidationError, nothing was written then;
/// output::OutputError, process::ProcessError.
void sweep(const SweepOptions& options) {
  const sweep::Plan plan(scene_file::read_source(options.scene.path), options.scene.overrides,
                         options.vary);
  const std::filesystem::path out = output_folder(options.out, plan.first().name, "_sweep");
  const sweep::Summary summary = compute(plan, out, options);
  if (!options.quiet) {
    fmt::print("{}", text(summary, out));
  }
}

}  // namespace

void add_sweep_command(CLI::App& program) {
  const auto options = std::make_shared<SweepOptions>();
  CLI::App* command = program.add_subcommand(
      "sweep",
      "Run a scene for every combination of the values of some keys, on all cores; "
      "interrupted, the same command goes on from there");
  add_scene_options(*command, options->scene);
  command
      ->add_option("--vary", options->vary,
                   "A key and its values, evenly spaced or, with :log, by equal factors, e.g. "
                   "friction.contact_stiffness_N_per_m=1e4:1e6:32:log, of one value FROM is TO; or "
                   "KEY=A,B,C, words or numbers, e.g. friction.law=dahl,coulomb, where a key that "
                   "one word does not use may stand in the scene for another; repeatable, the "
                   "first key changes slowest. velocity_ratio stands for sliding velocity over "
                   "peak vibration velocity of the steady state without friction, "
                   "Fe w / |Ks - m w^2 + i c w|")
      ->required()
      ->type_name("KEY=FROM:TO:COUNT[:log]|KEY=A,B,...")
      ->allow_extra_args(false);
  add_output_option(*command, options->out,
                    "sweep.csv, sweep.svg (one or two keys) and report.html [out/<scene "
                    "name>_sweep]");
  add_threads_option(*command, options->threads);
  command->add_flag("--quiet", options->quiet, "No progress bar and no printed summary");
  command->callback([options] { sweep(*options); });
}

}  // namespace sonoglide::cli
