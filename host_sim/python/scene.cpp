#include "host_sim/python/scene.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <utility>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/python/bindings.hpp"

namespace sonoglide::python {

Scene::Scene(scene_file::Source text, std::vector<std::string> changes)
    : source(std::move(text)),
      overrides(std::move(changes)),
      experiment(experiment::read(source, overrides)) {}

namespace {

namespace py = pybind11;

using Overrides = std::vector<std::string>;

Scene read_file(const std::filesystem::path& path, Overrides overrides) {
  return {scene_file::read_source(path), std::move(overrides)};
}

Scene read_text(const std::string& file, const std::string& text, Overrides overrides) {
  return {scene_file::Source{file, text}, std::move(overrides)};
}

/// With more overrides, which win over those before.
Scene change(const Scene& scene, const Overrides& more) {
  Overrides all = scene.overrides;
  all.insert(all.end(), more.begin(), more.end());
  return {scene.source, std::move(all)};
}

py::tuple origin_of(const Scene& scene) {
  return py::make_tuple(scene.source.file, scene.source.text, scene.overrides);
}

}  // namespace

void add_scene(py::module_& module) {
  py::class_<Scene>(module, "Scene")
      .def(py::init(&read_file))
      .def(py::init(&read_text))
      .def(py::init(&change))
      .def("origin", &origin_of)
      .def_property_readonly("name",
                             [](const Scene& scene) { return scene.experiment.nominal.name; })
      .def_property_readonly(
          "json",
          [](const Scene& scene) { return text_of(experiment::echo_of(scene.experiment.nominal)); })
      .def_property_readonly(
          "toml", [](const Scene& scene) { return experiment::text_of(scene.experiment.nominal); });
}

}  // namespace sonoglide::python
