#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "hal/board.hpp"
#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/experiment.hpp"
#include "host_sim/loop/control/control_port.hpp"
#include "host_sim/loop/plant/snapshot.hpp"
#include "host_sim/python/answer.hpp"
#include "host_sim/python/bindings.hpp"
#include "host_sim/python/pickled.hpp"
#include "host_sim/python/scene.hpp"

namespace sonoglide::python {
namespace {

configure::Experiment with_controller(configure::Experiment experiment) {
  if (!experiment.design) {
    throw configure::ConfigurationError("controller", "missing; allowed: a scene in closed loop");
  }
  if (experiment.design->bias) {
    throw configure::ConfigurationError(
        "drive.bias_limit_N", "a Unit has no bias force among its answers; allowed: 0, or a Loop");
  }
  return experiment;
}

/// The shipped controller alone: codes in, codes out.
class ControllerUnit {
 public:
  /// Begins with the first target of the scene, or with its texture, which it follows until a target is
  /// set.
  /// @throws configure::ConfigurationError  the scene has no controller, or one that answers with a bias
  explicit ControllerUnit(configure::Experiment experiment)
      : experiment_(with_controller(std::move(experiment))),
        port_(loop::make_control_port(scene(), *experiment_.design)) {
    if (!scene().controller->texture) {
      set_target(scene().controller->targets().front().value);
    }
  }

  /// One control step: the answer to the sample of a carrier period. Of a unit that observes no
  /// vibration that part of the sample is left out, and the answer's frequency is 0.
  const hal::ResonantDrive& step(const hal::VibrationSample& sample) {
    if (scene().sensor.vibration) {
      answer_ = port_->exchange(sample);
    } else {
      static_cast<hal::Drive&>(answer_) = port_->exchange(static_cast<const hal::Sample&>(sample));
    }
    return answer_;
  }

  /// All 0 before the first step.
  const hal::ResonantDrive& answer() const { return answer_; }

  double target() const { return target_; }
  /// @throws std::invalid_argument  it is not in (0, Scene::highest_target()]
  void set_target(double target) {
    if (!(target > 0.0 && target <= scene().highest_target())) {
      throw std::invalid_argument(
          scene().controller->holds_force()
              ? fmt::format("target is {}; allowed: a friction force above 0, at most {} N", target,
                            scene().highest_target())
              : fmt::format("target is {}; allowed: a friction ratio above 0, at most 1", target));
    }
    target_ = target;
    port_->set_target(target);
  }

  bool observes_vibration() const { return scene().sensor.vibration.has_value(); }
  const configure::ControlScales& scales() const { return experiment_.design->scales; }

  pybind11::bytes save() {
    return pickled([this](loop::StateCopy& copy) { copy_state(copy); });
  }
  /// @param pickled  by a unit of the same scene
  /// @throws std::invalid_argument  it cannot be that
  void restore(const pybind11::bytes& pickled) {
    unpickle(pickled, [this](loop::StateCopy& copy) { copy_state(copy); });
  }

 private:
  void copy_state(loop::StateCopy& copy) {
    copy(target_, answer_);
    port_->copy_state(copy);
  }

  const scene::Scene& scene() const { return experiment_.plant; }

  configure::Experiment experiment_;
  std::unique_ptr<loop::ControlPort> port_;
  double target_ = 0.0;
  hal::ResonantDrive answer_{};
};

/// An object that computes without the interpreter's lock belongs to one thread meanwhile.
/// Made and destroyed with the interpreter's lock held.
class InUse {
 public:
  /// @throws std::runtime_error  another thread uses it
  explicit InUse(bool& used) : used_(used) {
    if (used_) {
      throw std::runtime_error("in use by another thread");
    }
    used_ = true;
  }
  ~InUse() { used_ = false; }
  InUse(const InUse&) = delete;
  InUse& operator=(const InUse&) = delete;

 private:
  bool& used_;
};

namespace py = pybind11;

using Codes = py::array_t<std::int32_t, py::array::c_style>;

struct Unit {
  ControllerUnit controller;
  bool used = false;
};

std::int32_t code(long long value, const char* name) {
  using Limits = std::numeric_limits<std::int32_t>;
  if (value < Limits::min() || value > Limits::max()) {
    throw py::value_error(
        fmt::format("{} is {}; allowed: {} to {}", name, value, Limits::min(), Limits::max()));
  }
  return static_cast<std::int32_t>(value);
}

void require_vibration(const Unit& unit, bool given) {
  if (unit.controller.observes_vibration() != given) {
    throw py::value_error(given ? "this unit observes no vibration; allowed: no in_phase_code, no "
                                  "quadrature_code"
                                : "this unit observes the vibration; in_phase_code and "
                                  "quadrature_code are missing");
  }
}

std::int32_t step_once(Unit& unit, long long force, long long velocity,
                       const std::optional<long long>& in_phase,
                       const std::optional<long long>& quadrature, bool fresh, bool force_at_rail,
                       bool velocity_at_rail) {
  require_vibration(unit, in_phase && quadrature);
  const InUse use(unit.used);
  const hal::VibrationSample sample{{code(force, "force_code"), code(velocity, "velocity_code"),
                                     force_at_rail, fresh, velocity_at_rail},
                                    code(in_phase.value_or(0), "in_phase_code"),
                                    code(quadrature.value_or(0), "quadrature_code"),
                                    false,
                                    fresh};
  return unit.controller.step(sample).amplitude;
}

/// @param codes  absent: `otherwise` for every sample
const std::int32_t* data_of(const std::optional<Codes>& codes, const Codes& force,
                            const char* name) {
  if (!codes) {
    return nullptr;
  }
  if (codes->ndim() != 1 || codes->size() != force.size()) {
    throw py::value_error(fmt::format("{} has {} codes in {} dimensions; allowed: {} in one", name,
                                      codes->size(), codes->ndim(), force.size()));
  }
  return codes->data();
}

Codes array_for(const std::optional<Codes>& out, const Codes& force) {
  if (!out) {
    return Codes(force.size());
  }
  data_of(out, force, "out");
  return *out;
}

Codes step_all(Unit& unit, const Codes& force, const Codes& velocity,
               const std::optional<Codes>& in_phase, const std::optional<Codes>& quadrature,
               const std::optional<Codes>& out) {
  require_vibration(unit, in_phase && quadrature);
  const std::int32_t* forces = data_of(force, force, "force_codes");
  const std::int32_t* velocities = data_of(velocity, force, "velocity_codes");
  const std::int32_t* in_phases = data_of(in_phase, force, "in_phase_codes");
  const std::int32_t* quadratures = data_of(quadrature, force, "quadrature_codes");
  Codes amplitudes = array_for(out, force);
  std::int32_t* answers = amplitudes.mutable_data();
  const py::ssize_t count = force.size();
  const InUse use(unit.used);
  const py::gil_scoped_release released;
  for (py::ssize_t i = 0; i < count; ++i) {
    const hal::VibrationSample sample{{forces[i], velocities[i], false, true},
                                      in_phases != nullptr ? in_phases[i] : 0,
                                      quadratures != nullptr ? quadratures[i] : 0,
                                      false,
                                      true};
    answers[i] = unit.controller.step(sample).amplitude;
  }
  return amplitudes;
}

py::dict answer_of(const Unit& unit) {
  const hal::ResonantDrive& answer = unit.controller.answer();
  py::dict fields;
  add_answer(fields, answer);
  fields["frequency_steps"] = answer.frequency;
  return fields;
}

}  // namespace

void add_unit(py::module_& module) {
  py::class_<Unit> unit(module, "Unit");
  unit.def(py::init([](const Scene& scene) { return Unit{ControllerUnit(scene.experiment)}; }));
  unit.def("save", [](Unit& self) { return self.controller.save(); });
  unit.def("restore", [](Unit& self, const py::bytes& state) { self.controller.restore(state); });
  unit.def(
      "step", &step_once, py::arg("force_code"), py::arg("velocity_code"),
      py::arg("in_phase_code") = py::none(), py::arg("quadrature_code") = py::none(), py::kw_only(),
      py::arg("fresh") = true, py::arg("force_at_rail") = false,
      py::arg("velocity_at_rail") = false,
      "step(self, force_code, velocity_code, in_phase_code=None, quadrature_code=None, *, "
      "fresh=True, force_at_rail=False, velocity_at_rail=False)\n--\n\n"
      "One control step, the last carrier period of controller.every_periods. -> amplitude code of\n"
      "the drive, 2**31 being the actuator's limit\n\n"
      "force_code       mean friction force of the carrier period, over force_full_scale_N\n"
      "velocity_code    sliding velocity, over velocity_full_scale_m_per_s\n"
      "in_phase_code, quadrature_code\n"
      "                 vibration velocity, over velocity_full_scale_m_per_s; of a unit that\n"
      "                 observes it\n"
      "fresh            False: no sample has arrived since the last one\n"
      "force_at_rail    True: the force converter stands at an end of its range\n"
      "velocity_at_rail True: the velocity converter does");
  unit.def("steps", &step_all, py::arg("force_codes"), py::arg("velocity_codes"),
           py::arg("in_phase_codes") = py::none(), py::arg("quadrature_codes") = py::none(),
           py::kw_only(), py::arg("out").noconvert() = py::none(),
           "steps(self, force_codes, velocity_codes, in_phase_codes=None, quadrature_codes=None, "
           "*, out=None)\n--\n\n"
           "The same for arrays, a sample each, while other threads run. -> amplitude codes\n\n"
           "out  int32 array that takes them; None: a new one");
  unit.def_property_readonly(
      "answer", &answer_of,
      "All of the last answer: amplitude_code, commanded_ratio_code (2**31 is a ratio of 2),\n"
      "state, limit, fault, settling; frequency_steps of a resonant unit.");
  unit.def_property(
      "target", [](const Unit& self) { return self.controller.target(); },
      [](Unit& self, double target) {
        const InUse use(self.used);
        self.controller.set_target(target);
      },
      "Target friction ratio, above 0, at most 1; of a scene with target_friction_force_N a force\n"
      "[N], at most force_full_scale_N.");
  unit.def_property_readonly(
      "force_full_scale_N", [](const Unit& self) { return self.controller.scales().force_N; },
      "Friction force of code 2**31 [N].");
  unit.def_property_readonly(
      "velocity_full_scale_m_per_s",
      [](const Unit& self) { return self.controller.scales().velocity_m_per_s; },
      "Sliding or vibration velocity of code 2**31 [m/s].");
  unit.def_property_readonly(
      "amplitude_full_scale_N",
      [](const Unit& self) { return self.controller.scales().drive_amplitude_N; },
      "Drive amplitude of code 2**31 [N].");
}

}  // namespace sonoglide::python
