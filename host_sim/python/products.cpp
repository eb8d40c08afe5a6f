#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "host_sim/boards/emulated/controller_header.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/fmi/archive/make_fmu.hpp"
#include "host_sim/process/output_folder.hpp"
#include "host_sim/python/bindings.hpp"
#include "host_sim/python/scene.hpp"

namespace sonoglide::python {
namespace {

namespace py = pybind11;

template <class Value, std::size_t Count>
Value named(const std::array<scene::Named<Value>, Count>& words, const char* argument,
            const std::string& word) {
  if (const auto value = scene::value_of(words, word)) {
    return *value;
  }
  throw py::value_error(fmt::format("{} is \"{}\"; allowed: \"{}\"", argument, word,
                                    fmt::join(scene::words_of(words), "\", \"")));
}

/// -> the headers by their names
std::map<std::string, std::string> configure(const Scene& scene,
                                             const std::optional<std::string>& plant) {
  std::map<std::string, std::string> headers = {
      {emulated::controller_header_name, emulated::controller_header(scene.experiment)}};
  if (plant) {
    headers[emulated::plant_header_name] = emulated::plant_header(
        scene.experiment, named(emulated::plant_arithmetics, "plant", *plant));
  }
  return headers;
}

/// @param version  absent: the first of them
/// @param engine   its folder
void fmu(const Scene& scene, const std::string& kind, const std::optional<std::string>& version,
         const std::filesystem::path& engine, const std::filesystem::path& path) {
  const loop::Kind what = named(loop::kinds, "kind", kind);
  const fmi::Version interface =
      version ? named(fmi::versions, "fmi", *version) : fmi::versions.front().value;
  loop::require_usable(scene.experiment.plant, what);
  const std::string name = path.filename().string();
  process::OutputFolder folder(std::filesystem::absolute(path).parent_path(), {name});
  folder.write(name, fmi::make_fmu(scene.experiment.nominal, what, interface,
                                   fmi::find_parts(engine), "sonoglide " SONOGLIDE_VERSION));
  folder.commit();
}

}  // namespace

void add_products(py::module_& module) {
  module.attr("version") = SONOGLIDE_VERSION;
  module.def("configure", &configure);
  module.def("fmu", &fmu);
}

}  // namespace sonoglide::python
