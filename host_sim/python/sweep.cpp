#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <vector>

#include "firmware/control/interface/names.hpp"
#include "host_sim/python/arguments.hpp"
#include "host_sim/python/bindings.hpp"
#include "host_sim/python/scene.hpp"
#include "host_sim/studies/sweep/plan.hpp"
#include "host_sim/studies/sweep/row.hpp"
#include "host_sim/studies/sweep/solve.hpp"

namespace sonoglide::python {
namespace {

namespace py = pybind11;

py::object axis_column(const sweep::Grid& grid, std::size_t axis) {
  if (grid.axes()[axis].has_words()) {
    py::list column;
    for (std::size_t point = 0; point < grid.size(); ++point) {
      column.append(grid.text(point, axis));
    }
    return column;
  }
  py::array_t<double> column(static_cast<py::ssize_t>(grid.size()));
  for (std::size_t point = 0; point < grid.size(); ++point) {
    column.mutable_at(point) = grid.number(point, axis);
  }
  return column;
}

py::array_t<double> figure_column(const std::vector<sweep::PointResult>& rows,
                                  double sweep::PointResult::*figure) {
  py::array_t<double> column(static_cast<py::ssize_t>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    column.mutable_at(i) = rows[i].*figure;
  }
  return column;
}

template <class Word>
py::list word_column(const std::vector<sweep::PointResult>& rows, const Word& word) {
  py::list column;
  for (const sweep::PointResult& row : rows) {
    column.append(word(row));
  }
  return column;
}

py::dict sweep_columns(const sweep::Plan& plan, const std::vector<sweep::PointResult>& rows) {
  using sweep::PointResult;
  py::dict columns;
  for (std::size_t axis = 0; axis < plan.grid().axes().size(); ++axis) {
    columns[py::str(plan.grid().axes()[axis].key)] = axis_column(plan.grid(), axis);
  }
  columns["friction_ratio_whole_run"] = figure_column(rows, &PointResult::friction_ratio_whole_run);
  columns["friction_ratio_window"] = figure_column(rows, &PointResult::friction_ratio_window);
  columns["dissipation_ratio_window"] = figure_column(rows, &PointResult::dissipation_ratio_window);
  if (plan.first().load) {
    columns["load_final_velocity_m_per_s"] =
        figure_column(rows, &PointResult::load_final_velocity_m_per_s);
    columns["load_final_displacement_m"] =
        figure_column(rows, &PointResult::load_final_displacement_m);
  }
  if (plan.closed_loop() && plan.first().controller->texture) {
    columns["texture_mean_error"] = figure_column(rows, &PointResult::texture_mean_error);
    columns["texture_amplitude_ratio"] = figure_column(rows, &PointResult::texture_amplitude_ratio);
    columns["texture_lag_deg"] = figure_column(rows, &PointResult::texture_lag_deg);
  } else if (plan.closed_loop()) {
    columns["settling_time_s"] = figure_column(rows, &PointResult::settling_time_s);
    columns["steady_error"] = figure_column(rows, &PointResult::steady_error);
    columns["ripple"] = figure_column(rows, &PointResult::ripple);
    columns["limit"] =
        word_column(rows, [](const PointResult& row) { return control::name(row.limit); });
  }
  if (plan.closed_loop()) {
    columns["fault"] =
        word_column(rows, [](const PointResult& row) { return control::name(row.fault); });
  }
  columns["status"] = word_column(rows, [](const PointResult& row) { return row.status; });
  return columns;
}

/// @param vary  as options --vary of the command
py::dict sweep_scene(const Scene& scene, const std::vector<std::string>& vary,
                     const py::object& threads) {
  const unsigned most_threads = thread_limit(threads);
  std::optional<sweep::Plan> plan;
  std::vector<sweep::PointResult> rows;
  {
    const py::gil_scoped_release released;
    plan.emplace(scene.source, scene.overrides, vary);
    rows = sweep::compute_rows(*plan, most_threads);
  }
  return sweep_columns(*plan, rows);
}

}  // namespace

void add_sweep(py::module_& module) {
  module.def("sweep", &sweep_scene);
}

}  // namespace sonoglide::python
