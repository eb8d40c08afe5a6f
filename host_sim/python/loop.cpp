#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include "host_sim/configure/experiment.hpp"
#include "host_sim/loop/control_run.hpp"
#include "host_sim/loop/plant/carrier_grid.hpp"
#include "host_sim/loop/plant/snapshot.hpp"
#include "host_sim/loop/stepped.hpp"
#include "host_sim/python/answer.hpp"
#include "host_sim/python/arguments.hpp"
#include "host_sim/python/bindings.hpp"
#include "host_sim/python/pickled.hpp"
#include "host_sim/python/scene.hpp"

namespace sonoglide::python {
namespace {

const configure::Experiment& usable(const configure::Experiment& experiment) {
  loop::require_usable(experiment.plant, loop::Kind::loop);
  loop::require_constant_carrier(experiment.plant);
  return experiment;
}

namespace py = pybind11;

/// A closed loop that is stepped from outside, in the shape of a task for reinforcement learning.
class Loop {
 public:
  /// @throws configure::ConfigurationError  the scene has no controller, or its carrier period changes
  explicit Loop(const configure::Experiment& experiment)
      : experiment_(usable(experiment)),
        period_s_(1.0 / experiment.plant.drive->frequency_Hz),
        scene_periods_(loop::CarrierGrid(experiment.plant).count()),
        schedule_(loop::target_schedule(experiment.plant, loop::CarrierGrid(experiment.plant))) {
    reset(std::nullopt);
  }

  /// To the beginning of the scene.
  /// @param seed  of the sensor's noise; absent: the scene's
  void reset(std::optional<std::uint64_t> seed) {
    std::uint64_t& own = experiment_.plant.sensor.seed;
    own = seed.value_or(own);
    engine_ = std::make_unique<loop::SteppedScene>(experiment_, loop::Kind::loop);
    periods_ = 0;
    load_force_N_ = 0.0;
    wanted_ = coming();
  }

  /// One carrier period.
  /// @param target  that the controller is given, above 0, at most highest_target(); absent: as before,
  ///                at the beginning the scene's steps or its texture
  /// @throws loop::ComputationError, std::invalid_argument  the target is out of range
  void step(std::optional<double> target) {
    if (target && !(*target > 0.0 && *target <= highest_target())) {
      throw std::invalid_argument(
          holds_force()
              ? fmt::format(
                    "target is {}; allowed: a friction force above 0, at most {} N, or None",
                    *target, highest_target())
              : fmt::format("target is {}; allowed: a friction ratio above 0, at most 1, or None",
                            *target));
    }
    loop::Inputs inputs;
    inputs.target = target.value_or(0.0);
    inputs.load_force_N = load_force_N_;
    wanted_ = coming();
    const double begin_m = engine_->plant().sliding_distance_m;
    engine_->advance(inputs);
    ++periods_;
    if (texture()) {
      wanted_ = texture()->at(0.5 * (begin_m + engine_->plant().sliding_distance_m));
    }
  }

  /// On the load, beside that of the scene, from the next step on; 0 until it is set.
  double load_force_N() const { return load_force_N_; }
  /// @throws std::invalid_argument  the scene has no load, or the force is not finite
  void set_load_force_N(double force_N) {
    if (!has_load()) {
      throw std::invalid_argument("load_force_N: the scene has no load; required: a table [load]");
    }
    if (!std::isfinite(force_N)) {
      throw std::invalid_argument(
          fmt::format("load_force_N is {}; allowed: a finite force [N]", force_N));
    }
    load_force_N_ = force_N;
  }

  const loop::SteppedScene& engine() const { return *engine_; }
  double time_s() const { return static_cast<double>(periods_) * period_s_; }
  /// The targets are forces [N]; else friction ratios.
  bool holds_force() const { return experiment_.plant.controller->holds_force(); }
  bool has_load() const { return experiment_.plant.load.has_value(); }
  double highest_target() const { return experiment_.plant.highest_target(); }
  /// Friction ratio of the period that was stepped last, or mean friction along the sliding [N].
  double held() const {
    return holds_force() ? engine_->plant().resistance_N : engine_->plant().friction_ratio;
  }
  /// Target of the scene, for the period that was stepped last.
  double wanted() const { return wanted_; }
  /// Target of the scene, for the period that comes next; of a texture where the middle of that period
  /// lies if the velocity stays.
  double coming() const {
    if (texture()) {
      const loop::PlantOutputs& now = engine_->plant();
      return texture()->at(now.sliding_distance_m + 0.5 * period_s_ * now.sliding_velocity_m_per_s);
    }
    const auto every = static_cast<std::uint64_t>(experiment_.plant.controller->every_periods);
    double wanted = schedule_.front().target;
    for (const loop::ScheduledTarget& each : schedule_) {
      if (each.place <= periods_ / every) {
        wanted = each.target;
      }
    }
    return wanted;
  }
  /// The scene's duration is over.
  bool over() const { return periods_ >= scene_periods_; }
  std::uint64_t seed() const { return experiment_.plant.sensor.seed; }

  py::bytes save() {
    return pickled([this](loop::StateCopy& copy) { copy_state(copy); });
  }
  /// @param pickled  by a loop of the same scene and seed
  /// @throws std::invalid_argument  it cannot be that
  void restore(const py::bytes& pickled) {
    unpickle(pickled, [this](loop::StateCopy& copy) { copy_state(copy); });
  }

 private:
  const std::optional<scene::Texture>& texture() const {
    return experiment_.plant.controller->texture;
  }
  void copy_state(loop::StateCopy& copy) {
    copy(periods_, wanted_, load_force_N_);
    engine_->copy_state(copy);
  }

  configure::Experiment experiment_;
  double period_s_;
  std::uint64_t scene_periods_;
  std::vector<loop::ScheduledTarget> schedule_;
  std::unique_ptr<loop::SteppedScene> engine_;
  std::uint64_t periods_ = 0;
  double wanted_ = 0.0;
  double load_force_N_ = 0.0;
};

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
  const char* const held = loop.holds_force() ? "friction_force_N" : "friction_ratio";
  info[py::str(fmt::format("wanted_{}", held))] = loop.wanted();
  info[py::str(fmt::format("coming_{}", held))] = loop.coming();
  info["mean_friction_force_N"] = engine.plant().mean_friction_force_N;
  if (loop.holds_force()) {
    info["friction_force_along_sliding_N"] = loop.held();
  }
  if (loop.has_load()) {
    info["load_displacement_m"] = engine.plant().load_displacement_m;
  }
  add_answer(info, engine.controller().answer);
  return info;
}

py::tuple reset(Loop& loop, const std::optional<py::object>& seed, const py::object& /*options*/) {
  loop.reset(seed ? std::optional(seed_of(*seed)) : std::nullopt);
  return py::make_tuple(observation_of(loop), info_of(loop));
}

py::tuple step(Loop& loop, const std::optional<double>& target) {
  loop.step(target);
  const double reward = -std::abs(loop.held() - loop.wanted());
  const bool terminated = loop.engine().controller().answer.fault != 0;
  return py::make_tuple(observation_of(loop), reward, terminated, loop.over(), info_of(loop));
}

}  // namespace

void add_loop(py::module_& module) {
  py::class_<Loop> loop(module, "Loop");
  loop.def(py::init([](const Scene& scene) { return std::make_unique<Loop>(scene.experiment); }));
  loop.def_property_readonly("seed", &Loop::seed, "Of the sensor's noise.");
  loop.def("save", &Loop::save);
  loop.def("restore", &Loop::restore);
  loop.def("reset", &reset, py::arg("seed") = py::none(), py::arg("options") = py::none(),
           "reset(self, seed=None, options=None)\n--\n\n"
           "To the beginning. -> observation, info\n\n"
           "seed     of the sensor's noise; None: the scene's, or the last one given\n"
           "options  not used");
  loop.def("step", &step, py::arg("target") = py::none(),
           "step(self, target=None)\n--\n\n"
           "One carrier period. -> observation, reward, terminated, truncated, info\n\n"
           "target  friction ratio that the controller is given, above 0, at most 1; of a scene\n"
           "        with target_friction_force_N a force [N], at most sensor.force_full_scale_N;\n"
           "        None: as before, and until the first one the steps of the scene, or its\n"
           "        texture. The controller is given it at the end of the carrier period\n\n"
           "reward      -|friction ratio of the period - the one that the scene wants|; of target\n"
           "            forces -|mean friction force along the sliding - the wanted one| [N]\n"
           "terminated  a fault has switched the drive off\n"
           "truncated   the duration of the scene is over\n"
           "info        time_s, what the scene wants of this period and of the coming one, the\n"
           "            mean friction force of the period, of target forces that along the\n"
           "            sliding, of a scene with a load its displacement, and the controller's\n"
           "            answer: amplitude_code (2**31 is the actuator's limit),\n"
           "            commanded_ratio_code (2**31 is a ratio of 2), state, limit, fault,\n"
           "            settling");
  loop.def_property_readonly("holds_force", &Loop::holds_force,
                             "Targets are friction forces [N]; else friction ratios.");
  loop.def_property_readonly("highest_target", &Loop::highest_target,
                             "The highest that step() takes: a ratio of 1, or what the sensor\n"
                             "reads at most [N].");
  loop.def_property(
      "load_force_N", &Loop::load_force_N, &Loop::set_load_force_N,
      "Force on the load from the next step on [N], beside that of the scene and\n"
      "along the sliding; 0 after reset(). Of a scene without a load it is 0 and cannot\n"
      "be set.");
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
