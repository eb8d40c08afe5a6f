#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "host_sim/cli/identify_commands.hpp"
#include "host_sim/cli/options.hpp"
#include "host_sim/cli/progress_bar.hpp"
#include "host_sim/studies/identify/friction/report.hpp"
#include "host_sim/studies/identify/text_file.hpp"

namespace sonoglide::cli {
namespace {

namespace fitting = identify::friction;

struct FrictionOptions {
  std::string file;
  std::vector<std::string> laws;
  std::string out;  ///< empty: out/<file name>_friction
  bool quiet = false;
};

std::string check_law(const std::string& name) {
  const auto& known = fitting::fitted_laws();
  return std::find(known.begin(), known.end(), name) != known.end()
             ? std::string()
             : fmt::format("\"{}\" is no law that can be fitted; allowed: {}", name,
                           fmt::join(known, ", "));
}

/// A signal ends it at once: nothing is written yet.
fitting::Comparison compute(fitting::Readings readings, const FrictionOptions& options) {
  ProgressBar bar(stderr, !options.quiet);
  return fitting::compare(std::move(readings), options.laws,
                          [&](double fraction) { bar.update(fraction); });
}

/// Throws scene_file::SceneError, output::OutputError; in each case nothing was written.
void identify_friction(const FrictionOptions& options) {
  const scene_file::Source source = identify::read_text(options.file);
  fitting::Readings readings = fitting::read_readings(source);
  const std::filesystem::path out = output_folder(options.out, source.name(), "_friction");
  require_writable(out, {"report.html", "identify.json", "scene.toml"});
  const fitting::Comparison comparison = compute(std::move(readings), options);
  fitting::write(out, comparison, source.name());
  if (!options.quiet) {
    fmt::print("{}", fitting::text(comparison, out));
  }
}

}  // namespace

void add_identify_friction_command(CLI::App& group) {
  const auto options = std::make_shared<FrictionOptions>();
  CLI::App* command = group.add_subcommand(
      "friction", "Friction laws fitted to measured friction under vibration, and compared");
  command
      ->add_option("file", options->file,
                   "A table with sliding_velocity_m_per_s, vibration_velocity_m_per_s or "
                   "velocity_ratio, and friction_ratio or friction_force_N")
      ->required()
      ->type_name("FILE");
  command->add_option("--law", options->laws, "Fit this law alone; repeatable")
      ->type_name("NAME")
      ->allow_extra_args(false)
      ->check(check_law);
  add_output_option(*command, options->out,
                    "report.html, identify.json and scene.toml [out/<file name>_friction]");
  command->add_flag("--quiet", options->quiet, "No progress bar and no printed summary");
  command->callback([options] { identify_friction(*options); });
}

}  // namespace sonoglide::cli
