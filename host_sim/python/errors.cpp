#include <pybind11/pybind11.h>

#include <exception>
#include <string>
#include <utility>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/process/file_error.hpp"
#include "host_sim/process/pipe.hpp"
#include "host_sim/python/bindings.hpp"
#include "host_sim/scene_file/scene_error.hpp"

namespace sonoglide::python {
namespace {

namespace py = pybind11;

/// Of the module, as long as the interpreter lives.
PyObject* new_error(py::module_& module, const char* name, PyObject* base, const char* doc) {
  const std::string full_name = std::string("sonoglide.") + name;
  PyObject* error = PyErr_NewExceptionWithDoc(full_name.c_str(), doc, base, nullptr);
  if (error == nullptr) {
    throw py::error_already_set();
  }
  module.attr(name) = py::handle(error);
  return error;
}

PyObject* scene_error = nullptr;
PyObject* computation_error = nullptr;

void raise(const scene_file::SceneError& error) {
  const py::object raised = py::handle(scene_error)(error.what());
  raised.attr("file") = error.file();
  raised.attr("line") = error.line();
  raised.attr("column") = error.column();
  raised.attr("key") = error.key();
  raised.attr("reason") = error.message();
  PyErr_SetObject(scene_error, raised.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(std::move(thrown));
  } catch (const scene_file::SceneError& error) {
    raise(error);
  } catch (const configure::ConfigurationError& error) {
    PyErr_SetString(PyExc_ValueError, (error.key() + ": " + error.what()).c_str());
  } catch (const loop::ComputationError& error) {
    PyErr_SetString(computation_error, error.what());
  } catch (const process::FileError& error) {
    PyErr_SetString(PyExc_OSError, error.what());
  } catch (const process::ProcessError& error) {
    PyErr_SetString(PyExc_OSError, error.what());
  }
}

}  // namespace

void add_errors(py::module_& module) {
  scene_error = new_error(
      module, "SceneError", PyExc_ValueError,
      "A scene that cannot be used. str() is `FILE:LINE:COLUMN: KEY: what is wrong, what is\n"
      "allowed`; file, line, column, key and reason are its parts. Of an override the file is\n"
      "`--set` and the line its place among the overrides, from 1.");
  computation_error = new_error(module, "ComputationError", PyExc_ArithmeticError,
                                "A solver failed: str() has time, state and reason.");
  py::register_local_exception_translator(translate);
}

}  // namespace sonoglide::python
