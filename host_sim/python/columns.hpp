/// Columns of a table in memory as numpy sees them: nothing is copied, nothing can be written.
#pragma once

#include <pybind11/numpy.h>

#include <type_traits>
#include <vector>

namespace sonoglide::python {

/// An enumeration shows its number.
template <class Value, bool = std::is_enum_v<Value>>
struct Element {
  using type = Value;
};
template <class Value>
struct Element<Value, true> {
  using type = std::underlying_type_t<Value>;
};

/// The member of every row.
/// @param owner  of the rows, which do not move any more; kept alive by the view
template <class Row, class Value>
pybind11::array column(const std::vector<Row>& rows, Value Row::*member,
                       const pybind11::object& owner) {
  namespace py = pybind11;
  const py::dtype type = py::dtype::of<typename Element<Value>::type>();
  if (rows.empty()) {
    return py::array(type, 0);
  }
  py::array view(type, {static_cast<py::ssize_t>(rows.size())},
                 {static_cast<py::ssize_t>(sizeof(Row))}, &(rows.front().*member), owner);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

/// A column that is a vector of its own.
template <class Value>
pybind11::array column(const std::vector<Value>& values, const pybind11::object& owner) {
  namespace py = pybind11;
  if (values.empty()) {
    return py::array(py::dtype::of<Value>(), 0);
  }
  py::array view(py::dtype::of<Value>(), {static_cast<py::ssize_t>(values.size())},
                 {static_cast<py::ssize_t>(sizeof(Value))}, values.data(), owner);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

}  // namespace sonoglide::python
