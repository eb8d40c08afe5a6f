#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "host_sim/python/answer.hpp"
#include "host_sim/python/bindings.hpp"
#include "host_sim/python/pickled.hpp"
#include "host_sim/python/scene.hpp"
#include "host_sim/python/stepped_loop.hpp"

namespace sonoglide::python {
namespace {

namespace py = pybind11;

using Loop = SteppedLoop;

constexpr std::array observation_names = {"friction_ratio",           "drive_force_amplitude_N",
                                          "sliding_velocity_m_per_s", "displacement_m",
                                          "velocity_m_per_s",         "friction_force_N"};

py::array_t<double> observation_of(const Loop& loop) {
  const loop::SteppedScene& engine = loop.engine();
  const loop::PlantOutputs& plant = engine.plant();
  const std::array values = {
      plant.friction_ratio,           engine.controller().drive_force_amplitude_N,
      plant.sliding_velocity_m_per_s, plant.displacement_m,
      plant.velocity_m_per_s,         plant.friction_force_N};
  static_assert(values.size() == observation_names.size());
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::dict info_of(const Loop& loop) {
  const loop::SteppedScene& engine = loop.engine();
  py::dict info;
  info["time_s"] = loop.time_s();
  info["wanted_friction_ratio"] = loop.wanted_ratio();
  info["coming_friction_ratio"] = loop.coming_ratio();
  info["mean_friction_force_N"] = engine.plant().mean_friction_force_N;
  add_answer(info, engine.controller().answer);
  return info;
}

py::tuple reset(Loop& loop, std::optional<std::uint64_t> seed, const py::object& /*options*/) {
  loop.reset(seed);
  return py::make_tuple(observation_of(loop), info_of(loop));
}

py::tuple step(Loop& loop, const std::optional<double>& target) {
  if (target && !(*target > 0.0)) {
    throw py::value_error(fmt::format(
        "target is {}; allowed: a friction ratio above 0, at most 1, or None", *target));
  }
  loop.step(target.value_or(0.0));
  const loop::SteppedScene& engine = loop.engine();
  const double reward = -std::abs(engine.plant().friction_ratio - loop.wanted_ratio());
  const bool terminated = engine.controller().answer.fault != 0;
  return py::make_tuple(observation_of(loop), reward, terminated, loop.over(), info_of(loop));
}

}  // namespace

void add_loop(py::module_& module) {
  py::class_<Loop> loop(module, "Loop");
  loop.def(py::init([](const Scene& scene) { return std::make_unique<Loop>(scene.experiment); }));
  loop.def_property_readonly("seed", &Loop::seed, "Of the sensor's noise.");
  loop.def("save", [](const Loop& self) { return bytes_of(self.save()); });
  loop.def("restore", [](Loop& self, const py::bytes& state) { self.restore(snapshot_of(state)); });
  loop.def("reset", &reset, py::arg("seed") = py::none(), py::arg("options") = py::none(),
           "reset(self, seed=None, options=None)\n--\n\n"
           "To the beginning. -> observation, info\n\n"
           "seed     of the sensor's noise; None: the scene's, or the last one given\n"
           "options  not used");
  loop.def("step", &step, py::arg("target") = py::none(),
           "step(self, target=None)\n--\n\n"
           "One carrier period. -> observation, reward, terminated, truncated, info\n\n"
           "target  friction ratio that the controller is given, above 0, at most 1; None: as\n"
           "        before, and until the first one the steps of the scene\n\n"
           "reward      -|friction ratio of the period - the one that the scene wants|\n"
           "terminated  a fault has switched the drive off\n"
           "truncated   the duration of the scene is over\n"
           "info        time_s, what the scene wants of this period and of the coming one, the\n"
           "            mean friction force of the period, and the controller's answer:\n"
           "            amplitude_code (2**31 is the actuator's limit), commanded_ratio_code\n"
           "            (2**31 is a ratio of 2), state, limit, fault, settling");
  loop.def(
      "observe",
      [](const Loop& self) { return py::make_tuple(observation_of(self), info_of(self)); },
      "observe(self)\n--\n\n"
      "-> observation, info as the last step had them");
  loop.def_property_readonly(
      "trace_hash",
      [](const Loop& self) {
        return fmt::format("{:016x}", self.engine().controller().trace_hash);
      },
      "Of every drive command so far, bit for bit: after a whole scene that of run().");
  loop.def_property_readonly_static(
      "observation_names", [](const py::object& /*type*/) { return py::cast(observation_names); },
      "Of the numbers of an observation, the unit in the name.");
}

}  // namespace sonoglide::python
