#include "host_sim/python/scene.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <utility>

#include "host_sim/experiment/experiment.hpp"
#include "host_sim/python/bindings.hpp"
#include "host_sim/scene_file/source.hpp"
#include "host_sim/scene_file/to_json.hpp"
#include "host_sim/scene_file/to_toml.hpp"

namespace sonoglide::python {

Scene::Scene(scene_file::Source text, std::vector<std::string> changes)
    : source(std::move(text)),
      overrides(std::move(changes)),
      values(experiment::read(source, overrides).scene) {}

Scene Scene::with(const std::vector<std::string>& more) const {
  std::vector<std::string> all = overrides;
  all.insert(all.end(), more.begin(), more.end());
  return {source, std::move(all)};
}

namespace {

namespace py = pybind11;

std::string toml_of(const py::handle& value);

std::string toml_table(const py::dict& table) {
  std::string text;
  for (const auto& [key, value] : table) {
    text +=
        (text.empty() ? "" : ", ") + nlohmann::json(key_of(key)).dump() + " = " + toml_of(value);
  }
  return "{ " + text + " }";
}

std::string toml_array(const py::handle& values) {
  std::string text;
  for (const py::handle each : values) {
    text += (text.empty() ? "" : ", ") + toml_of(each);
  }
  return "[" + text + "]";
}

/// Numbers with every bit.
std::string toml_of(const py::handle& value) {
  if (py::hasattr(value, "tolist")) {
    return toml_of(value.attr("tolist")());  // numpy's
  }
  if (py::isinstance<py::bool_>(value)) {
    return py::cast<bool>(value) ? "true" : "false";
  }
  if (py::isinstance<py::str>(value)) {
    return nlohmann::json(py::cast<std::string>(value)).dump();
  }
  if (py::isinstance<py::dict>(value)) {
    return toml_table(py::cast<py::dict>(value));
  }
  if (py::isinstance<py::int_>(value) || py::isinstance<py::float_>(value)) {
    return py::repr(value);
  }
  return toml_array(value);
}

/// A dictionary `table.key` -> value as options of `sonoglide run --set`; None removes a key.
std::vector<std::string> overrides_of(const py::dict& values) {
  std::vector<std::string> overrides;
  for (const auto& [key, value] : values) {
    overrides.push_back(key_of(key) + "=" + (value.is_none() ? std::string() : toml_of(value)));
  }
  return overrides;
}

Scene read_file(const std::filesystem::path& path, const py::dict& overrides) {
  return {scene_file::read_source(path), overrides_of(overrides)};
}

Scene read_text(const std::string& text, const py::dict& overrides, const std::string& name) {
  return {scene_file::Source{name, text}, overrides_of(overrides)};
}

py::tuple state_of(const Scene& scene) {
  return py::make_tuple(scene.source.file, scene.source.text, scene.overrides);
}

Scene scene_of(const py::tuple& state) {
  return {{py::cast<std::string>(state[0]), py::cast<std::string>(state[1])},
          py::cast<std::vector<std::string>>(state[2])};
}

}  // namespace

void add_scene(py::module_& module) {
  py::class_<Scene>(
      module, "Scene",
      "A scene: plant, friction, drive, solver and controller of one run. It does not\n"
      "change.\n\n"
      "path       a scene file (TOML)\n"
      "overrides  {\"table.key\": value}, in the units of the keys; None removes a key\n\n"
      "Raises SceneError, with line and column.")
      .def(py::init(&read_file), py::arg("path"), py::arg("overrides") = py::dict(),
           "__init__(self, path, overrides={})\n--\n\n")
      .def_static("from_text", &read_text, py::arg("text"), py::arg("overrides") = py::dict(),
                  py::arg("name") = "scene",
                  "from_text(text, overrides={}, name='scene')\n--\n\n"
                  "The same from TOML text; name stands for the file in errors.")
      .def(
          "replace",
          [](const Scene& scene, const py::dict& values) {
            return scene.with(overrides_of(values));
          },
          py::arg("overrides"),
          "replace(self, overrides)\n--\n\nThe scene with more overrides: they win.")
      .def_property_readonly(
          "name", [](const Scene& scene) { return scene.values.name; },
          "Of the file, without its ending.")
      .def_property_readonly(
          "values", [](const Scene& scene) { return to_python(scene_file::to_json(scene.values)); },
          "{table: {key: value}} with every default filled in; SI units, as the keys say.")
      .def_property_readonly(
          "toml",
          [](const Scene& scene) { return scene_file::to_toml(scene_file::to_json(scene.values)); },
          "The same as the text of a scene file.")
      .def("__repr__",
           [](const Scene& scene) { return "<sonoglide.Scene " + scene.values.name + ">"; })
      .def(
          "__copy__", [](const Scene& scene) { return scene; }, "__copy__(self)\n--\n\n")
      .def(
          "__deepcopy__", [](const Scene& scene, const py::dict& /*memo*/) { return scene; },
          py::arg("memo"), "__deepcopy__(self, memo)\n--\n\n")
      .def(py::pickle(&state_of, &scene_of));
}

}  // namespace sonoglide::python
