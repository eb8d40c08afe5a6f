#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "host_sim/cli/commands.hpp"
#include "host_sim/cli/options.hpp"
#include "host_sim/process/printable.hpp"
#include "host_sim/studies/commission/commission.hpp"
#include "host_sim/studies/identify/plant/study.hpp"

namespace sonoglide::cli {
namespace {

namespace plant = identify::plant;

struct CommissionOptions {
  std::string device;
  SceneOptions scene;
  StudyOptions study;
};

/// Told before the scene is read: that from a serial line would never come.
std::string no_file(const std::string& device) {
  std::error_code absent;
  return std::filesystem::is_regular_file(device, absent)
             ? fmt::format("\"{}\" is a file; allowed: a serial device, and then the scene",
                           process::printable(device))
             : std::string();
}

/// Throws scene_file::SceneError, process::ProcessError, process::FileError; nothing was written then.
void commission_unit(const CommissionOptions& options) {
  const SceneInput input(options.scene);
  const experiment::Experiment experiment = input.read();
  input.with_places([&] { plant::require_identifiable(experiment); });
  run_study(
      options.study, output_folder(options.study.out, experiment.nominal.name, "_commission"),
      {"report.html", "identify.json", "fit.csv", "commissioned.toml"},
      [&](const auto& progress) { return commission::study(options.device, experiment, progress); },
      plant::report);
}

}  // namespace

void add_commission_command(CLI::App& program) {
  const auto options = std::make_shared<CommissionOptions>();
  CLI::App* command = program.add_subcommand(
      "commission",
      "Drive a running unit through some targets, for about half a minute, and fit the scene's "
      "plant to what it records; friction falls meanwhile, so what it holds may move, and at the end "
      "the unit is stopped");
  command->add_option("device", options->device, "Serial device of the unit")
      ->required()
      ->type_name("DEVICE")
      ->check(not_empty("a serial device"))
      ->check(no_file);
  add_scene_options(*command, options->scene, "the one that the unit's image was built from");
  add_study_options(*command, options->study,
                    "commissioned.toml, identify.json, fit.csv and report.html [out/<scene "
                    "name>_commission]");
  command->callback([options] { commission_unit(*options); });
}

}  // namespace sonoglide::cli
