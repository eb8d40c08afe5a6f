#include "host_sim/studies/commission/commission.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <vector>

#include "host_sim/boards/emulated/controller_header.hpp"
#include "host_sim/boards/unit/plant_traces.hpp"
#include "host_sim/boards/unit/unit_link.hpp"
#include "host_sim/boards/unit/unit_refusal.hpp"
#include "host_sim/process/pipe.hpp"
#include "host_sim/process/printable.hpp"
#include "host_sim/process/serial_port.hpp"

namespace sonoglide::commission {

namespace plant = identify::plant;

namespace {

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

}  // namespace

plant::PlantStudy study(const std::string& device, const configure::Experiment& experiment,
                        const std::function<void(double)>& progress) {
  process::SerialPort port(device);
  unit::UnitLink link(port);
  if (!unit::has_design(link, emulated::design_number(experiment))) {
    throw process::ProcessError(fmt::format(
        "{}: the unit has another design than the scene; required: the scene that its image was "
        "built from",
        process::printable(device)));
  }
  constexpr double recording = 0.5;  // of the work
  const std::vector<double> targets = plant::targets(experiment.nominal);
  const auto traces = [&] {
    try {
      return unit::record_plant(link, targets, [&](double part) { progress(recording * part); });
    } catch (const unit::UnitRefusal& refusal) {
      throw process::ProcessError(
          fmt::format("{}: the unit refuses: {}", process::printable(device), refusal.what()));
    }
  }();
  const char* const unit = experiment.nominal.controller->holds_force() ? " N" : "";
  return plant::study(experiment, stretches_of(traces, targets, unit),
                      [&](double part) { progress(recording + (1.0 - recording) * part); });
}

}  // namespace sonoglide::commission
