#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "host_sim/cli/commands.hpp"
#include "host_sim/cli/options.hpp"
#include "host_sim/configure/controller_parameters.hpp"
#include "host_sim/emulated/controller_header.hpp"
#include "host_sim/process/pipe.hpp"
#include "host_sim/process/printable.hpp"
#include "host_sim/process/serial_port.hpp"
#include "host_sim/studies/identify/plant/study.hpp"
#include "host_sim/unit/plant_traces.hpp"
#include "host_sim/unit/unit_link.hpp"

namespace sonoglide::cli {
namespace {

namespace plant = identify::plant;

struct CommissionOptions {
  std::string device;
  SceneOptions scene;
  StudyOptions study;
};

/// @param targets  of the traces at the same places; the first trace is undriven
std::vector<plant::Stretch> stretches_of(const std::vector<unit::RecordedTrace>& traces,
                                         const std::vector<double>& targets, const char* unit) {
  std::vector<plant::Stretch> all;
  for (const unit::RecordedTrace& trace : traces) {
    const std::size_t number = all.size();
    plant::Stretch& stretch = all.emplace_back();
    stretch.name =
        number == 0 ? "Undriven" : fmt::format("Target {:.6g}{}", targets.at(number), unit);
    stretch.before = trace.state.before;
    for (const link::TraceRecord& record : trace.records) {
      stretch.steps.push_back(
          {record.friction_force, record.sliding_velocity, record.amplitude, record.other});
    }
  }
  return all;
}

plant::PlantStudy study(const CommissionOptions& options, const experiment::Experiment& experiment,
                        const std::function<void(double)>& progress) {
  process::SerialPort port(options.device);
  unit::UnitLink link(port);
  if (!unit::has_design(link, emulated::design_number(experiment))) {
    throw process::ProcessError(fmt::format(
        "{}: the unit has another design than the scene; required: the scene that its image was "
        "built from",
        process::printable(options.device)));
  }
  constexpr double recording = 0.5;  // of the work
  const std::vector<double> targets = plant::targets(experiment.nominal);
  const auto traces =
      unit::record_plant(link, targets, [&](double part) { progress(recording * part); });
  const char* const unit = experiment.nominal.controller->holds_force() ? " N" : "";
  return plant::study(experiment, stretches_of(traces, targets, unit),
                      [&](double part) { progress(recording + (1.0 - recording) * part); });
}

/// Throws scene_file::SceneError, process::ProcessError, process::FileError; nothing was written then.
void commission(const CommissionOptions& options) {
  const SceneInput input(options.scene);
  const experiment::Experiment experiment = input.read();
  input.with_places([&] { plant::require_identifiable(experiment); });
  run_study(
      options.study, output_folder(options.study.out, experiment.nominal.name, "_commission"),
      {"report.html", "identify.json", "fit.csv", "commissioned.toml"},
      [&](const auto& progress) { return study(options, experiment, progress); }, plant::report);
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
      ->check(not_empty("a serial device"));
  add_scene_options(*command, options->scene, "the one that the unit's image was built from");
  add_study_options(*command, options->study,
                    "commissioned.toml, identify.json, fit.csv and report.html [out/<scene "
                    "name>_commission]");
  command->callback([options] { commission(*options); });
}

}  // namespace sonoglide::cli
