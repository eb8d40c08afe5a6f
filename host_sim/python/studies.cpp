#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host_sim/process/scratch_folder.hpp"
#include "host_sim/process/thread_limit.hpp"
#include "host_sim/python/arguments.hpp"
#include "host_sim/python/bindings.hpp"
#include "host_sim/python/scene.hpp"
#include "host_sim/studies/commission/commission.hpp"
#include "host_sim/studies/design/report.hpp"
#include "host_sim/studies/identify/friction/comparison.hpp"
#include "host_sim/studies/identify/impedance/study.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"
#include "host_sim/studies/identify/text_file.hpp"
#include "host_sim/studies/robust/report.hpp"
#include "host_sim/studies/robust/study.hpp"

namespace sonoglide::python {
namespace {

namespace py = pybind11;

/// What the command writes: its JSON, and a scene; empty where there is none.
using Found = std::pair<std::string, std::string>;

Found identify_friction(const scene_file::Source& readings, const std::vector<std::string>& laws) {
  namespace friction = identify::friction;
  for (const std::string& law : laws) {
    if (const std::string wrong = friction::check_law(law); !wrong.empty()) {
      throw py::value_error(wrong);
    }
  }
  const py::gil_scoped_release released;
  const friction::Comparison found =
      friction::compare(friction::read_readings(readings), laws, [](double) {});
  return {text_of(friction::to_json(found)), found.scene};
}

void require_in(const identify::impedance::Range& range, const char* name,
                const std::optional<double>& value) {
  if (value) {
    require(*value >= range.least && *value <= range.most, name, *value,
            fmt::format("{:g} to {:g}", range.least, range.most));
  }
}

Found identify_impedance(const scene_file::Source& sweep, const std::optional<double>& mass_kg,
                         const std::optional<double>& force_factor_N_per_V) {
  namespace impedance = identify::impedance;
  require_in(impedance::mass_range_kg, "mass_kg", mass_kg);
  require_in(impedance::force_factor_range_N_per_V, "force_factor_N_per_V", force_factor_N_per_V);
  if (mass_kg && force_factor_N_per_V) {
    throw py::value_error("mass_kg and force_factor_N_per_V; allowed: one of them");
  }
  const py::gil_scoped_release released;
  const impedance::ImpedanceStudy found =
      impedance::study(sweep.name(), impedance::read_sweep(sweep), {mass_kg, force_factor_N_per_V});
  return {text_of(identify::to_json(found.identification)), found.scene};
}

Found commission_unit(const std::string& device, const Scene& scene) {
  identify::plant::require_identifiable(scene.experiment);
  const py::gil_scoped_release released;
  const identify::plant::PlantStudy found =
      commission::study(device, scene.experiment, [](double /*done*/) {
        const py::gil_scoped_acquire held;
        if (PyErr_CheckSignals() != 0) {
          throw py::error_already_set();
        }
      });
  return {text_of(identify::to_json(found.fit.identification)), found.scene};
}

Found find_worst(const Scene& scene, const py::object& samples, const py::object& search,
                 const py::object& seed, const py::object& threads) {
  const robust::Counts counts{integer(samples, "samples", 1, robust::most_samples),
                              integer(search, "search", 0, robust::most_samples), seed_of(seed)};
  const unsigned most_threads = thread_limit(threads);
  const py::gil_scoped_release released;
  const robust::Task task(scene.source, scene.overrides, counts);
  const process::ScratchFolder folder(std::filesystem::temp_directory_path());
  const process::ThreadLimit limit(most_threads);
  robust::check_samples(task, {0, task.counts().samples});
  robust::Solver solver(task, folder.path(), "sonoglide", {});
  const robust::Study found = solver.solve({});
  return {text_of(robust::to_json(task, found)), task.plant_text(found.worst.factors)};
}

std::string design_scene(const Scene& scene, const std::vector<double>& ratios,
                         const std::optional<std::pair<double, double>>& velocity_m_per_s) {
  std::optional<design::SpeedRange> speeds;
  if (velocity_m_per_s) {
    speeds = {velocity_m_per_s->first, velocity_m_per_s->second};
    require(design::is_allowed(*speeds), "velocity_m_per_s",
            fmt::format("{}, {}", speeds->slowest_m_per_s, speeds->fastest_m_per_s),
            design::allowed_speeds());
  }
  for (const double ratio : ratios) {
    require(design::is_allowed(ratio), "ratio", ratio, design::allowed_ratios());
  }
  const py::gil_scoped_release released;
  return text_of(design::to_json(
      design::study(design::make_task(scene.experiment, ratios, speeds), [](double) {})));
}

}  // namespace

void add_studies(py::module_& module) {
  py::class_<scene_file::Source>(module, "Measurements")
      .def(py::init([](const std::filesystem::path& path) { return identify::read_text(path); }))
      .def(py::init([](const std::string& name, const std::string& text) {
        return scene_file::Source{name, text};
      }));
  module.def("identify_friction", &identify_friction);
  module.def("identify_impedance", &identify_impedance);
  module.def("commission", &commission_unit);
  const robust::Counts counts;
  module.def("robust", &find_worst, py::arg("scene"), py::kw_only(),
             py::arg("samples") = counts.samples, py::arg("search") = counts.search,
             py::arg("seed") = counts.seed, py::arg("threads") = 0);
  module.def("design", &design_scene);
}

}  // namespace sonoglide::python
