#include "host_sim/loop/run.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "host_sim/loop/watch.hpp"
#include "host_sim/python/answer.hpp"
#include "host_sim/python/bindings.hpp"
#include "host_sim/python/scene.hpp"
#include "host_sim/report/run_csv.hpp"
#include "host_sim/report/run_findings.hpp"
#include "host_sim/report/run_report.hpp"
#include "host_sim/report/words.hpp"

namespace sonoglide::python {
namespace {

namespace py = pybind11;

// Columns of a table in memory as numpy sees them: nothing is copied, nothing can be written.

/// An enumeration shows its number.
template <class Value, bool = std::is_enum_v<Value>>
struct Element {
  using type = Value;
};
template <class Value>
struct Element<Value, true> {
  using type = std::underlying_type_t<Value>;
};

/// The member of every row.
/// @param owner  of the rows, which do not move any more; kept alive by the view
template <class Row, class Value>
py::array column(const std::vector<Row>& rows, Value Row::*member, const py::object& owner) {
  const py::dtype type = py::dtype::of<typename Element<Value>::type>();
  if (rows.empty()) {
    return py::array(type, 0);
  }
  py::array view(type, {static_cast<py::ssize_t>(rows.size())},
                 {static_cast<py::ssize_t>(sizeof(Row))}, &(rows.front().*member), owner);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

/// A column that is a vector of its own.
template <class Value>
py::array column(const std::vector<Value>& values, const py::object& owner) {
  if (values.empty()) {
    return py::array(py::dtype::of<Value>(), 0);
  }
  py::array view(py::dtype::of<Value>(), {static_cast<py::ssize_t>(values.size())},
                 {static_cast<py::ssize_t>(sizeof(Value))}, values.data(), owner);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

/// What the columns of a run are views of.
struct Recorded {
  loop::PeriodRecording periods;
  std::vector<double> drive_amplitude_V;  ///< with a transducer
  loop::Recording trace;
};

/// An interrupt from the keyboard ends a run.
void check_signals() {
  const py::gil_scoped_acquire acquired;
  if (PyErr_CheckSignals() != 0) {
    throw py::error_already_set();
  }
}

/// Fills the tables, and returns the content of summary.json.
std::string simulate(const experiment::Experiment& experiment, Recorded& recorded) {
  const scene::Scene& scene = experiment.plant;
  report::RunFindings findings(experiment);
  loop::Watch watch;
  findings.join(watch);
  const scene::Run& wanted = scene.run;
  if (!wanted.record.empty()) {
    watch.periods.push_back(&recorded.periods);
    watch.samples.push_back({{0.0, wanted.duration_s, wanted.record_interval_s}, &recorded.trace});
  }
  watch.progress = [](double /*fraction*/) { check_signals(); };
  const loop::RunResult result = loop::run(experiment, watch);
  const report::AmplitudeUnit unit = report::amplitude_unit(scene);
  if (unit.name == std::string_view("V")) {
    for (const loop::Period& each : recorded.periods.periods) {
      recorded.drive_amplitude_V.push_back(each.drive_amplitude_N * unit.per_N);
    }
  }
  return report::summary_text(experiment, result, findings);
}

/// Those of periods.csv, and more.
py::dict periods_of(const Recorded& recorded, const scene::Scene& scene, const py::object& owner) {
  using loop::Period;
  const bool of_force = report::target_unit(scene).is_force();
  const std::vector<Period>& rows = recorded.periods.periods;
  py::dict columns;
  columns["time_s"] = column(rows, &Period::begin_s, owner);
  columns["friction_ratio"] = column(rows, &Period::friction_ratio, owner);
  if (of_force) {
    columns["friction_force_N"] = column(rows, &Period::friction_force_N, owner);
  }
  columns[of_force ? "target_force_N" : "target"] = column(rows, &Period::target, owner);
  if (!recorded.drive_amplitude_V.empty()) {
    columns["drive_amplitude_V"] = column(recorded.drive_amplitude_V, owner);
  }
  columns["drive_amplitude_N"] = column(rows, &Period::drive_amplitude_N, owner);
  columns["sliding_velocity_m_per_s"] = column(rows, &Period::begin_velocity_m_per_s, owner);
  columns["frequency_Hz"] = column(rows, &Period::frequency_Hz, owner);
  columns["commanded_ratio"] = column(rows, &Period::commanded_ratio, owner);
  columns["state"] = column(rows, &Period::state, owner);
  columns["limit"] = column(rows, &Period::limit, owner);
  columns["settling"] = column(rows, &Period::settling, owner);
  if (scene.drive && scene.drive->bias_limit_N > 0.0) {
    columns["bias_N"] = column(rows, &Period::bias_N, owner);
  }
  return columns;
}

py::array trace_column(const loop::Recording& trace, scene::Channel channel,
                       const py::object& owner) {
  using loop::PlantState;
  switch (channel) {
    case scene::Channel::displacement:
      return column(trace.state, &PlantState::displacement_m, owner);
    case scene::Channel::velocity:
      return column(trace.state, &PlantState::velocity_m_per_s, owner);
    case scene::Channel::friction_force:
      return column(trace.state, &PlantState::friction_force_N, owner);
    case scene::Channel::drive_force:
      return column(trace.drive_force_N, owner);
    case scene::Channel::load_displacement:
      return column(trace.load_displacement_m, owner);
    case scene::Channel::sliding_velocity:
      break;
  }
  return column(trace.sliding_velocity_m_per_s, owner);
}

py::dict trace_of(const Recorded& recorded, const std::vector<scene::Channel>& channels,
                  const py::object& owner) {
  py::dict columns;
  columns["time_s"] = column(recorded.trace.time_s, owner);
  for (const scene::Channel channel : channels) {
    columns[py::str(report::name_of(channel))] = trace_column(recorded.trace, channel, owner);
  }
  return columns;
}

/// -> summary, periods, trace
py::tuple run(const Scene& scene) {
  auto recorded = std::make_unique<Recorded>();
  std::string summary;
  {
    const py::gil_scoped_release released;
    summary = simulate(scene.experiment, *recorded);
  }
  const Recorded& kept = *recorded;
  const py::capsule owner(recorded.release(),
                          [](void* all) { delete static_cast<Recorded*>(all); });
  const scene::Scene& plant = scene.experiment.plant;
  return py::make_tuple(summary, periods_of(kept, plant, owner),
                        trace_of(kept, plant.run.record, owner));
}

}  // namespace

void add_run(py::module_& module) {
  module.attr("states") = words_to(control::State::relearning);
  module.attr("limits") = words_to(control::Limit::self_excited);
  module.attr("settlings") = words_to(control::Settling::clamped);
  module.def("run", &run);
}

}  // namespace sonoglide::python
