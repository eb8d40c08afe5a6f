#include <pybind11/pybind11.h>

#include "host_sim/python/bindings.hpp"

namespace sonoglide::python {
namespace {

namespace py = pybind11;
using nlohmann::ordered_json;

/// What a path may hold that is no UTF-8 is replaced.
py::str text(const std::string& text) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace"));
}

}  // namespace

py::object to_python(const ordered_json& json) {
  switch (json.type()) {
    case ordered_json::value_t::object: {
      py::dict members;
      for (const auto& [key, value] : json.items()) {
        members[text(key)] = to_python(value);
      }
      return members;
    }
    case ordered_json::value_t::array: {
      py::list elements;
      for (const ordered_json& each : json) {
        elements.append(to_python(each));
      }
      return elements;
    }
    case ordered_json::value_t::string:
      return text(json.get_ref<const std::string&>());
    case ordered_json::value_t::boolean:
      return py::bool_(json.get<bool>());
    case ordered_json::value_t::number_integer:
      return py::int_(json.get<std::int64_t>());
    case ordered_json::value_t::number_unsigned:
      return py::int_(json.get<std::uint64_t>());
    case ordered_json::value_t::number_float:
      return py::float_(json.get<double>());
    default:
      return py::none();
  }
}

std::string key_of(const py::handle& key) {
  if (!py::isinstance<py::str>(key)) {
    throw py::type_error("a key is " + std::string(py::repr(key)) +
                         "; allowed: a text, \"table.key\" of a scene");
  }
  return py::cast<std::string>(key);
}

}  // namespace sonoglide::python
