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
  module.def("friction_ratio", py::vectorize(friction_ratio), py::arg("velocity_ratio"),
             py::arg("dahl_number"),
             "friction_ratio(velocity_ratio, dahl_number)\n--\n\n"
             "Friction ratio mean(F)/Fc of a contact under sinusoidal tangential vibration, in\n"
             "closed form; numbers or arrays, which are broadcast.\n\n"
             "velocity_ratio  sliding velocity over peak vibration velocity, Vt / v [-]\n"
             "dahl_number     Kt X / Fc [-], 1e-12 to 1e12; inf is a Coulomb contact, whose\n"
             "                ratio is (2/pi) asin r");
}

}  // namespace sonoglide::python
