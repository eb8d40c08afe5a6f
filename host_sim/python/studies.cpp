#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/control/interface/names.hpp"
#include "host_sim/python/bindings.hpp"
#include "host_sim/python/scene.hpp"
#include "host_sim/studies/identify/friction/comparison.hpp"
#include "host_sim/studies/identify/impedance/study.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"
#include "host_sim/studies/identify/text_file.hpp"
#include "host_sim/studies/sweep/plan.hpp"
#include "host_sim/studies/sweep/row.hpp"
#include "host_sim/studies/sweep/solve.hpp"

namespace sonoglide::python {
namespace {

namespace py = pybind11;

std::string listed(const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) {
    return py::cast<bool>(value) ? "true" : "false";
  }
  std::string text = py::str(value);
  if (text.empty() || text.find_first_of(",:") != std::string::npos) {
    throw py::value_error(
        fmt::format("a value is \"{}\"; allowed: numbers, words, truth values, or FROM:TO:COUNT in "
                    "place of all",
                    text));
  }
  return text;
}

/// {key: values} as options of `sonoglide sweep --vary`.
std::vector<std::string> vary_of(const py::dict& axes) {
  std::vector<std::string> vary;
  for (const auto& [key, given] : axes) {
    std::string values;
    if (py::isinstance<py::str>(given)) {
      values = py::cast<std::string>(given);
    } else {
      const py::object each =
          py::hasattr(given, "tolist") ? given.attr("tolist")() : py::cast<py::object>(given);
      for (const py::handle value : each) {
        values += (values.empty() ? "" : ",") + listed(value);
      }
    }
    vary.push_back(key_of(key) + "=" + values);
  }
  return vary;
}

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
  if (plan.closed_loop()) {
    columns["settling_time_s"] = figure_column(rows, &PointResult::settling_time_s);
    columns["steady_error"] = figure_column(rows, &PointResult::steady_error);
    columns["ripple"] = figure_column(rows, &PointResult::ripple);
    columns["limit"] =
        word_column(rows, [](const PointResult& row) { return control::name(row.limit); });
    columns["fault"] =
        word_column(rows, [](const PointResult& row) { return control::name(row.fault); });
  }
  columns["status"] = word_column(rows, [](const PointResult& row) { return row.status; });
  return columns;
}

py::dict sweep_scene(const Scene& scene, const py::dict& vary, unsigned threads) {
  const std::vector<std::string> options = vary_of(vary);
  std::optional<sweep::Plan> plan;
  std::vector<sweep::PointResult> rows;
  {
    const py::gil_scoped_release released;
    plan.emplace(scene.source, scene.overrides, options);
    rows = sweep::compute_rows(*plan, threads);
  }
  return sweep_columns(*plan, rows);
}

py::object identify_friction(const std::filesystem::path& path,
                             const std::vector<std::string>& laws) {
  for (const std::string& law : laws) {
    if (const std::string wrong = identify::friction::check_law(law); !wrong.empty()) {
      throw py::value_error(wrong);
    }
  }
  nlohmann::ordered_json found;
  {
    const py::gil_scoped_release released;
    namespace friction = identify::friction;
    found = friction::to_json(
        friction::compare(friction::read_readings(identify::read_text(path)), laws, [](double) {}));
  }
  return to_python(found);
}

void require_positive(const std::optional<double>& value, const char* name) {
  if (value && !(std::isfinite(*value) && *value > 0.0)) {
    throw py::value_error(fmt::format("{} is {}; allowed: a number above 0", name, *value));
  }
}

py::object identify_impedance(const std::filesystem::path& path,
                              const std::optional<double>& mass_kg,
                              const std::optional<double>& force_factor_N_per_V) {
  require_positive(mass_kg, "mass_kg");
  require_positive(force_factor_N_per_V, "force_factor_N_per_V");
  if (mass_kg && force_factor_N_per_V) {
    throw py::value_error("mass_kg and force_factor_N_per_V; allowed: one of them");
  }
  nlohmann::ordered_json found;
  {
    const py::gil_scoped_release released;
    namespace impedance = identify::impedance;
    const scene_file::Source source = identify::read_text(path);
    found = identify::to_json(impedance::study(source.name(), impedance::read_sweep(source),
                                               {mass_kg, force_factor_N_per_V})
                                  .identification);
  }
  return to_python(found);
}

}  // namespace

void add_studies(py::module_& module) {
  module.def("sweep", &sweep_scene, py::arg("scene"), py::arg("vary"), py::kw_only(),
             py::arg("threads") = 0,
             "sweep(scene, vary, *, threads=0)\n--\n\n"
             "Runs a scene for every combination of the values of some keys, on several threads,\n"
             "while other threads run. -> {name: column}, those of sweep.csv, in its order\n\n"
             "vary     {\"table.key\": values}: numbers, words, or a text FROM:TO:COUNT or\n"
             "         FROM:TO:COUNT:log; velocity_ratio is the sliding velocity over the peak\n"
             "         vibration velocity. The first key changes slowest.\n"
             "threads  0: one for each core\n\n"
             "A point that cannot be computed has NaN, and why in the column status. Raises\n"
             "SceneError for a point that is no scene: nothing is computed then.");
  module.def("identify_friction", &identify_friction, py::arg("path"),
             py::arg("laws") = std::vector<std::string>(),
             "identify_friction(path, laws=[])\n--\n\n"
             "Fits friction laws to measured friction under vibration, as `sonoglide identify\n"
             "friction`. -> the content of identify.json\n\n"
             "path  a table with sliding_velocity_m_per_s, vibration_velocity_m_per_s or\n"
             "      velocity_ratio, and friction_ratio or friction_force_N\n"
             "laws  words of scenes; none: all of them");
  module.def(
      "identify_impedance", &identify_impedance, py::arg("path"), py::arg("mass_kg") = py::none(),
      py::arg("force_factor_N_per_V") = py::none(),
      "identify_impedance(path, mass_kg=None, force_factor_N_per_V=None)\n--\n\n"
      "Fits the equivalent circuit of a transducer to a measured sweep of its impedance, as\n"
      "`sonoglide identify impedance`. -> the content of identify.json\n\n"
      "path                  a table with named columns, Touchstone .s1p, or the text of an\n"
      "                      Agilent 4294A\n"
      "mass_kg               the moving mass, from which the force factor follows\n"
      "force_factor_N_per_V  the force factor, from which the moving mass follows");
}

}  // namespace sonoglide::python
