/// Keys of the dictionaries that Python hands over.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace sonoglide::python {

/// @throws pybind11::type_error  it is no text
inline std::string key_of(const pybind11::handle& key) {
  namespace py = pybind11;
  if (!py::isinstance<py::str>(key)) {
    throw py::type_error("a key is " + std::string(py::repr(key)) +
                         "; allowed: a text, \"table.key\" of a scene");
  }
  return py::cast<std::string>(key);
}

}  // namespace sonoglide::python
