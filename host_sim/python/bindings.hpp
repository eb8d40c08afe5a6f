/// What the module is made of: each function adds a part to it.
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
void add_rollout(pybind11::module_& module);
void add_studies(pybind11::module_& module);

/// JSON as Python has it: dictionaries, lists, numbers, None.
pybind11::object to_python(const nlohmann::ordered_json& json);

/// A key of a dictionary that Python hands over.
/// @throws pybind11::type_error  it is no text
std::string key_of(const pybind11::handle& key);

}  // namespace sonoglide::python
