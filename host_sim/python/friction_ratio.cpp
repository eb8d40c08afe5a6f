#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cmath>
#include <stdexcept>

#include "firmware/friction/coulomb_friction_ratio.hpp"
#include "firmware/friction/dahl_friction_ratio.hpp"
#include "host_sim/python/bindings.hpp"

namespace sonoglide::python {
namespace {

namespace py = pybind11;

double friction_ratio(double velocity_ratio, double dahl_number) {
  if (!std::isfinite(velocity_ratio)) {
    throw std::invalid_argument(
        fmt::format("velocity_ratio is {}; allowed: a finite number", velocity_ratio));
  }
  if (std::isinf(dahl_number) && dahl_number > 0.0) {
    return friction::coulomb_friction_ratio(velocity_ratio);
  }
  if (!(dahl_number >= 1e-12 && dahl_number <= 1e12)) {
    throw std::invalid_argument(fmt::format(
        "dahl_number is {}; allowed: 1e-12 to 1e12, or inf for a Coulomb contact", dahl_number));
  }
  return friction::dahl_friction_ratio(velocity_ratio, dahl_number);
}

}  // namespace

void add_friction_ratio(py::module_& module) {
  module.def("friction_ratio", py::vectorize(friction_ratio));
}

}  // namespace sonoglide::python
