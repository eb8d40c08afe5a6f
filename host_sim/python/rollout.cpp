#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/process/thread_limit.hpp"
#include "host_sim/python/arguments.hpp"
#include "host_sim/python/bindings.hpp"
#include "host_sim/python/scene.hpp"
#include "host_sim/runs/rollouts.hpp"

namespace sonoglide::python {
namespace {

namespace py = pybind11;

using Table = py::array_t<double, py::array::c_style>;
using GivenTable = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Scenes = std::vector<const experiment::Experiment*>;

/// Of a tuple, which keeps them alive.
Scenes scenes_of(const py::tuple& kept) {
  Scenes each;
  for (const py::handle scene : kept) {
    if (!py::isinstance<Scene>(scene)) {
      throw py::type_error("scenes holds " + std::string(py::repr(scene)) +
                           "; allowed: a Scene, or several");
    }
    each.push_back(&py::cast<const Scene&>(scene).experiment);
  }
  return each;
}

std::size_t periods_of_all(const Scenes& scenes) {
  if (scenes.empty()) {
    return 0;
  }
  const std::size_t periods = runs::whole_periods(scenes.front()->plant);
  for (std::size_t i = 1; i < scenes.size(); ++i) {
    const std::size_t others = runs::whole_periods(scenes[i]->plant);
    if (others != periods) {
      throw py::value_error(fmt::format(
          "scene {} has {} whole carrier periods; allowed: {}, as scene 0", i, others, periods));
    }
  }
  return periods;
}

template <class Array>
void require_shape(const Array& array, const char* name, std::size_t rows, std::size_t columns) {
  const auto is = [&](int axis, std::size_t size) {
    return array.shape(axis) == static_cast<py::ssize_t>(size);
  };
  if (array.ndim() != 2 || !is(0, rows) || !is(1, columns)) {
    throw py::value_error(
        fmt::format("{} has another shape; allowed: {} rows, a rollout each, of {} carrier periods",
                    name, rows, columns));
  }
}

Table rollout(const py::tuple& kept, const std::optional<GivenTable>& targets,
              const std::optional<Table>& out, const py::object& threads) {
  const unsigned most_threads = thread_limit(threads);
  const Scenes each = scenes_of(kept);
  const std::size_t periods = periods_of_all(each);
  if (targets) {
    require_shape(*targets, "targets", each.size(), periods);
  }
  if (out) {
    require_shape(*out, "out", each.size(), periods);
  }
  Table ratios = out ? *out : Table(std::vector<std::size_t>{each.size(), periods});
  std::vector<runs::Rollout> all;
  for (std::size_t i = 0; i < each.size(); ++i) {
    all.push_back({*each[i], targets ? targets->data() + i * periods : nullptr,
                   ratios.mutable_data() + i * periods});
  }
  const py::gil_scoped_release released;
  const process::ThreadLimit limit(most_threads);
  runs::run_rollouts(all);
  return ratios;
}

}  // namespace

void add_rollout(py::module_& module) {
  module.def("rollout", &rollout, py::arg("scenes"), py::arg("targets"), py::arg("out").noconvert(),
             py::arg("threads"));
}

}  // namespace sonoglide::python
