#include "host_sim/loop/run.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host_sim/loop/watch.hpp"
#include "host_sim/python/answer.hpp"
#include "host_sim/python/bindings.hpp"
#include "host_sim/python/columns.hpp"
#include "host_sim/python/scene.hpp"
#include "host_sim/report/run_findings.hpp"
#include "host_sim/report/run_report.hpp"
#include "host_sim/scene/names.hpp"

namespace sonoglide::python {
namespace {

namespace py = pybind11;

struct Run {
  explicit Run(scene::Scene from) : scene(std::move(from)) {}
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  scene::Scene scene;
  loop::PeriodRecording periods;
  loop::Recording trace;
  nlohmann::ordered_json summary;
};

/// An interrupt from the keyboard ends a run.
void check_signals() {
  const py::gil_scoped_acquire acquired;
  if (PyErr_CheckSignals() != 0) {
    throw py::error_already_set();
  }
}

std::unique_ptr<Run> run(const Scene& scene) {
  auto made = std::make_unique<Run>(scene.values);
  const py::gil_scoped_release released;
  const auto design = configure::design_if_closed(made->scene);
  report::RunFindings findings(made->scene, design);
  loop::Watch watch;
  findings.join(watch);
  const scene::Run& wanted = made->scene.run;
  if (!wanted.record.empty()) {
    watch.periods.push_back(&made->periods);
    watch.samples.push_back({{0.0, wanted.duration_s, wanted.record_interval_s}, &made->trace});
  }
  watch.progress = [](double /*fraction*/) { check_signals(); };
  const loop::RunResult result = loop::run(made->scene, design, watch);
  made->summary = report::summary(made->scene, result, findings);
  return made;
}

py::dict periods_of(const py::object& self) {
  using loop::Period;
  const std::vector<Period>& rows = py::cast<const Run&>(self).periods.periods;
  py::dict columns;
  columns["time_s"] = column(rows, &Period::begin_s, self);
  columns["friction_ratio"] = column(rows, &Period::friction_ratio, self);
  columns["target"] = column(rows, &Period::target, self);
  columns["drive_amplitude_N"] = column(rows, &Period::drive_amplitude_N, self);
  columns["sliding_velocity_m_per_s"] = column(rows, &Period::begin_velocity_m_per_s, self);
  columns["frequency_Hz"] = column(rows, &Period::frequency_Hz, self);
  columns["commanded_ratio"] = column(rows, &Period::commanded_ratio, self);
  columns["state"] = column(rows, &Period::state, self);
  columns["limit"] = column(rows, &Period::limit, self);
  columns["settling"] = column(rows, &Period::settling, self);
  return columns;
}

py::array trace_column(const Run& run, scene::Channel channel, const py::object& self) {
  using loop::PlantState;
  switch (channel) {
    case scene::Channel::displacement:
      return column(run.trace.state, &PlantState::displacement_m, self);
    case scene::Channel::velocity:
      return column(run.trace.state, &PlantState::velocity_m_per_s, self);
    case scene::Channel::friction_force:
      return column(run.trace.state, &PlantState::friction_force_N, self);
    case scene::Channel::drive_force:
      return column(run.trace.drive_force_N, self);
    case scene::Channel::sliding_velocity:
      break;
  }
  return column(run.trace.sliding_velocity_m_per_s, self);
}

py::dict trace_of(const py::object& self) {
  const auto& run = py::cast<const Run&>(self);
  py::dict columns;
  columns["time_s"] = column(run.trace.time_s, self);
  for (const scene::Channel channel : run.scene.run.record) {
    columns[py::str(scene::name_of(scene::channels, channel))] = trace_column(run, channel, self);
  }
  return columns;
}

py::object trace_hash_of(const Run& run) {
  return run.summary.contains("control") ? to_python(run.summary["control"]["trace_hash"])
                                         : py::none();
}

}  // namespace

void add_run(py::module_& module) {
  module.attr("states") = words_to(control::State::relearning);
  module.attr("limits") = words_to(control::Limit::contact_lost);
  module.attr("settlings") = words_to(control::Settling::clamped);
  py::class_<Run>(module, "Run", "What a simulated scene comes to.")
      .def_property_readonly(
          "summary", [](const Run& run) { return to_python(run.summary); },
          "The content of summary.json, as `sonoglide run` writes it: every figure, and the\n"
          "scene with its defaults. A figure that is not defined is None.")
      .def_property_readonly(
          "trace_hash", &trace_hash_of,
          "Of every drive command, bit for bit: that of `sonoglide run`. None in open loop.")
      .def_property_readonly(
          "periods", &periods_of,
          "{name: column}, a value for each carrier period: those of periods.csv and more,\n"
          "the unit in the name. Empty columns if run.record of the scene is absent.\n"
          "They are read-only views: nothing is copied. state, limit and settling are places in\n"
          "states, limits and settlings.")
      .def_property_readonly(
          "trace", &trace_of,
          "{name: column}, the recorded channels at multiples of run.record_interval_s, as in\n"
          "trace.csv: the unit in the name. Read-only views: nothing is copied.");
  module.def("run", &run, py::arg("scene"),
             "run(scene)\n--\n\n"
             "Simulates a scene, in closed loop if it has a controller. Other threads run\n"
             "meanwhile. Raises ComputationError where the solver fails.");
}

}  // namespace sonoglide::python
