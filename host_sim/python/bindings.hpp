/// What the compiled part of the package is made of: each function adds a part to it. What can be
/// said in Python is said there: words, defaults, documentation.
#pragma once

#include <pybind11/pybind11.h>

#include <nlohmann/json.hpp>

#include <string>

namespace sonoglide::python {

void add_errors(pybind11::module_& module);
void add_scene(pybind11::module_& module);
void add_run(pybind11::module_& module);
void add_friction_ratio(pybind11::module_& module);
void add_loop(pybind11::module_& module);
void add_unit(pybind11::module_& module);
void add_port(pybind11::module_& module);
void add_rollout(pybind11::module_& module);
void add_sweep(pybind11::module_& module);
void add_studies(pybind11::module_& module);
void add_products(pybind11::module_& module);

/// JSON for json.loads. What a path may hold that is no UTF-8 is replaced.
inline std::string text_of(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace sonoglide::python
