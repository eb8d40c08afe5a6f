#include <pybind11/pybind11.h>

#include "host_sim/python/bindings.hpp"

PYBIND11_MODULE(_core, module) {
  // The documentation of a function begins with its signature, in the form that inspect reads.
  pybind11::options options;
  options.disable_function_signatures();
  namespace python = sonoglide::python;
  python::add_errors(module);
  python::add_scene(module);
  python::add_run(module);
  python::add_friction_ratio(module);
  python::add_loop(module);
  python::add_unit(module);
  python::add_port(module);
  python::add_rollout(module);
  python::add_sweep(module);
  python::add_studies(module);
  python::add_products(module);
}
