#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <optional>

#include "host_sim/python/answer.hpp"
#include "host_sim/python/bindings.hpp"
#include "host_sim/python/pickled.hpp"
#include "host_sim/python/scene.hpp"
#include "host_sim/python/stepped_loop.hpp"

namespace sonoglide::python {
namespace {

namespace py = pybind11;

struct Loop {
  Scene scene;  ///< what it is pickled as
  SteppedLoop stepped;
};

constexpr std::array observation_names = {"friction_ratio",           "drive_force_amplitude_N",
                                          "sliding_velocity_m_per_s", "displacement_m",
                                          "velocity_m_per_s",         "friction_force_N"};

py::array_t<double> observation_of(const Loop& loop) {
  const loop::SteppedScene& engine = loop.stepped.engine();
  const loop::PlantOutputs& plant = engine.plant();
  const std::array values = {
      plant.friction_ratio,           engine.controller().drive_force_amplitude_N,
      plant.sliding_velocity_m_per_s, plant.displacement_m,
      plant.velocity_m_per_s,         plant.friction_force_N};
  static_assert(values.size() == observation_names.size());
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::dict info_of(const Loop& loop) {
  const loop::SteppedScene& engine = loop.stepped.engine();
  py::dict info;
  info["time_s"] = loop.stepped.time_s();
  info["wanted_friction_ratio"] = loop.stepped.wanted_ratio();
  info["mean_friction_force_N"] = engine.plant().mean_friction_force_N;
  add_answer(info, engine.controller().answer);
  return info;
}

py::tuple reset(Loop& loop, std::optional<std::uint64_t> seed, const py::object& /*options*/) {
  loop.stepped.reset(seed);
  return py::make_tuple(observation_of(loop), info_of(loop));
}

py::tuple step(Loop& loop, const std::optional<double>& target) {
  if (target && !(*target > 0.0)) {
    throw py::value_error(fmt::format(
        "target is {}; allowed: a friction ratio above 0, at most 1, or None", *target));
  }
  loop.stepped.step(target.value_or(0.0));
  const loop::SteppedScene& engine = loop.stepped.engine();
  const double reward = -std::abs(engine.plant().friction_ratio - loop.stepped.wanted_ratio());
  const bool terminated = engine.controller().answer.fault != 0;
  return py::make_tuple(observation_of(loop), reward, terminated, loop.stepped.over(),
                        info_of(loop));
}

py::tuple state_of_loop(const Loop& loop) {
  return py::make_tuple(loop.scene, loop.stepped.seed(), bytes_of(loop.stepped.save()));
}

Loop loop_of(const py::tuple& state) {
  const auto& scene = py::cast<const Scene&>(state[0]);
  Loop loop{scene, SteppedLoop(scene.values)};
  loop.stepped.reset(py::cast<std::uint64_t>(state[1]));
  loop.stepped.restore(snapshot_of(py::cast<py::bytes>(state[2])));
  return loop;
}

}  // namespace

void add_loop(py::module_& module) {
  py::class_<Loop> loop(
      module, "Loop",
      "A closed loop stepped from outside, one carrier period at a time: plant, sensor,\n"
      "controller and actuator of a scene, joined as in run(). It has the shape of a task of\n"
      "Gymnasium, which it does not need. Copies and pickles go on from where it is, bit for bit;\n"
      "a pickle serves the same build of the module.");
  loop.def(py::init([](const Scene& scene) {
             return Loop{scene, SteppedLoop(scene.values)};
           }),
           py::arg("scene"), "__init__(self, scene)\n--\n\n");
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
           "info        time_s, what the scene wants, the mean friction force of the period, and\n"
           "            the controller's answer: amplitude_code (2**31 is the actuator's limit),\n"
           "            commanded_ratio_code (2**31 is a ratio of 2), state, limit, fault,\n"
           "            settling");
  loop.def_property_readonly(
      "trace_hash",
      [](const Loop& self) {
        return fmt::format("{:016x}", self.stepped.engine().controller().trace_hash);
      },
      "Of every drive command so far, bit for bit: after a whole scene that of run().");
  loop.def_property_readonly_static(
      "observation_names", [](const py::object& /*type*/) { return py::cast(observation_names); },
      "Of the numbers of an observation, the unit in the name.");
  loop.def(
      "__copy__", [](const Loop& self) { return self; }, "__copy__(self)\n--\n\n");
  loop.def(
      "__deepcopy__", [](const Loop& self, const py::dict& /*memo*/) { return self; },
      py::arg("memo"), "__deepcopy__(self, memo)\n--\n\n");
  loop.def(py::pickle(&state_of_loop, &loop_of));
}

}  // namespace sonoglide::python
