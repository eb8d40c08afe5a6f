#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "firmware/app/parameter_labels.hpp"
#include "firmware/app/unit_names.hpp"
#include "firmware/link/messages.hpp"
#include "hal/kept_exception.hpp"
#include "host_sim/boards/unit/step_recorder.hpp"
#include "host_sim/boards/unit/step_response.hpp"
#include "host_sim/boards/unit/stream_table.hpp"
#include "host_sim/boards/unit/tare.hpp"
#include "host_sim/boards/unit/unit_link.hpp"
#include "host_sim/boards/unit/unit_refusal.hpp"
#include "host_sim/boards/unit/unit_scales.hpp"
#include "host_sim/boards/unit/unit_trace.hpp"
#include "host_sim/boards/unit/unit_words.hpp"
#include "host_sim/process/printable.hpp"
#include "host_sim/process/serial_port.hpp"
#include "host_sim/python/bindings.hpp"

namespace sonoglide::python {
namespace {

namespace py = pybind11;
using app::parameter_labels;

constexpr auto target_parameter = static_cast<std::size_t>(app::Parameter::target);

/// A unit at a serial device, until it is closed. Several threads take turns.
class Port {
 public:
  explicit Port(const std::string& device, double patience_s)
      : device_(process::printable(device)),
        patience_(milliseconds(patience_s)),
        port_(std::in_place, device),
        link_(std::in_place, *port_, patience_),
        scales_(*link_) {}

  void close() {
    const py::gil_scoped_release released;
    const std::lock_guard turn(turn_);
    link_.reset();
    port_.reset();
  }

  py::dict identity() {
    const auto told = ask<link::Identity>(link::ReadIdentity{});
    py::dict identity;
    identity["version"] =
        fmt::format("{}.{}.{}", told.major_number, told.minor_number, told.patch_number);
    identity["design"] = told.design;
    identity["board"] = unit::board_of(told);
    identity["serial_number"] = told.serial_number;
    py::dict full_scales;
    for (std::size_t i = 0; i < link::quantity_count; ++i) {
      const auto quantity = static_cast<link::Quantity>(i);
      if (scales_.has(quantity)) {
        full_scales[scales_.column_of(quantity).c_str()] = scales_[quantity].value;
      }
    }
    identity["full_scales"] = full_scales;
    return identity;
  }

  py::dict status() {
    const auto told = ask<link::Telemetry>(link::ReadTelemetry{});
    py::dict status;
    status["period"] = told.period;
    const auto tell = [&](link::Quantity quantity, std::int32_t code) {
      status[scales_.column_of(quantity).c_str()] =
          scales_.value_of(quantity, static_cast<std::uint32_t>(code));
    };
    tell(link::Quantity::friction_force, told.friction_force);
    tell(link::Quantity::sliding_velocity, told.sliding_velocity);
    tell(link::Quantity::amplitude, told.amplitude);
    status[scales_.column_of(link::Quantity::target).c_str()] = scales_.target_of(told.target);
    status["state"] = control::name(static_cast<control::State>(told.state));
    status["limit"] = control::name(static_cast<control::Limit>(told.limit));
    status["fault"] = app::fault_name(told.fault);
    status["settling"] = control::name(static_cast<control::Settling>(told.settling));
    status["parameters"] = app::name(static_cast<store::Origin>(told.parameters));
    status["nominal_over_true_friction"] =
        told.mismatch == 0 ? py::object(py::none()) : py::float_(told.mismatch / 1e3);
    status["lost_frames"] = told.lost_frames;
    return status;
  }

  void set_target(double target) {
    ask<link::TargetSet>(link::SetTarget{count_of(target_parameter, target)}, target_parameter);
  }
  bool holds_force() const { return scales_.holds_force(); }

  py::dict step(double from, double to) {
    const auto [step, response] =
        recorded_step(count_of(target_parameter, from), count_of(target_parameter, to));
    py::dict told;
    told["settled_before"] = response.settled_before;
    const auto [state, limit, fault, settling] = unit::names_of_codes(response.end_codes);
    told["limit"] = limit;
    told["settling"] = settling;
    told["friction_force_before_N"] = response.before_N;
    told["friction_force_after_N"] = response.after_N;
    told["ripple_N"] = response.ripple_N;
    const auto& course = response.course;
    told["rise_s"] = course ? std::optional(course->rise_s) : std::nullopt;
    told["settling_s"] = course ? course->settling_s : std::nullopt;
    told["overshoot"] = course ? std::optional(course->overshoot) : std::nullopt;
    told["trace"] = columns_of(step.trace);
    return told;
  }

  void stop() { ask<link::Stopped>(link::Stop{}); }
  void restart() { ask<link::Restarted>(link::Restart{}); }
  void confirm() { ask<link::Confirmed>(link::Confirm{}, 0, unit::longest_save); }

  py::list faults() {
    py::list faults;
    for (std::uint8_t age = 0; age < UINT8_MAX; ++age) {
      const auto fault = ask_if_kept<link::LoggedFault>(link::ReadFault{age});
      if (!fault) {
        break;
      }
      py::dict entry;
      entry["period"] = fault->period;
      entry["fault"] = app::fault_name(fault->fault);
      faults.append(entry);
    }
    return faults;
  }

  std::optional<py::dict> exception() {
    const auto told = ask_if_kept<link::KeptException>(link::ReadException{});
    if (!told) {
      return std::nullopt;
    }
    const hal::KeptException kept = hal::exception_of(told->words);
    py::dict exception;
    hal::KeptException::visit_words(
        kept, [&](const char* name, std::uint32_t word) { exception[name] = word; });
    return exception;
  }

  std::optional<py::dict> history() {
    const auto told = ask_if_kept<link::History>(link::ReadHistory{});
    if (!told) {
      return std::nullopt;
    }
    py::dict history;
    history["boots"] = told->boots;
    history["cause"] = unit::cause_name(told->cause);
    history["operation_s"] = told->seconds;
    history["watchdog_resets"] = told->watchdog_resets;
    history["exceptions"] = told->exceptions;
    history["exception_boot"] =
        told->exceptions != 0 ? std::optional(told->exception_boot) : std::nullopt;
    history["saved"] = told->saved != 0;
    history["began_anew"] = told->began_anew != 0;
    return history;
  }

  py::dict parameter(const std::string& name) {
    const std::size_t number = unit::parameter_named(name);
    const auto told =
        ask<link::ParameterValue>(link::ReadParameter{static_cast<std::uint8_t>(number)}, number);
    py::dict parameter;
    parameter["value"] = scales_.value_of_parameter(number, told.value);
    parameter["lowest"] = scales_.value_of_parameter(number, told.lowest);
    parameter["highest"] = scales_.value_of_parameter(number, told.highest);
    parameter["compiled_in"] = scales_.value_of_parameter(number, told.preset);
    return parameter;
  }

  void set_parameter(const std::string& name, double value) {
    const std::size_t number = unit::parameter_named(name);
    link::WriteParameter request{};
    request.parameter = static_cast<std::uint8_t>(number);
    request.value = number < app::parameter_count ? count_of(number, value) : UINT32_MAX;
    ask<link::ParameterWritten>(request, number, unit::longest_save);
  }

  py::dict tare() {
    const unit::Tared tared = in_turn([&] { return unit::tare(open_link(), scales_); });
    py::dict told;
    told["force_offset_before_N"] =
        scales_.value_of_parameter(unit::offset_parameter, tared.before);
    told["force_offset_N"] = scales_.value_of_parameter(unit::offset_parameter, tared.after);
    told["standard_error_N"] = tared.standard_error_N;
    told["readings_equal"] = tared.readings_equal;
    return told;
  }

 private:
  /// The nearest; but half a period is none, and next to nothing is not nothing.
  /// @throws std::invalid_argument
  std::uint32_t count_of(std::size_t parameter, double value) const {
    const app::ParameterLabel& label = parameter_labels[parameter];
    if (label.decimal_places == 0 && value != std::floor(value)) {
      throw std::invalid_argument(fmt::format("{}: {} is no whole number", label.name, value));
    }
    const std::uint32_t count = scales_.count_of_parameter(parameter, value);
    if (count == 0 && value != 0.0) {
      throw std::invalid_argument(
          fmt::format("{}: {} is less than the unit can tell from 0", label.name, value));
    }
    return count;
  }

  std::pair<unit::RecordedStep, unit::StepResponse> recorded_step(std::uint32_t from,
                                                                  std::uint32_t to) {
    return in_turn([&] {
      auto step = unit::StepRecorder(open_link(), scales_).step_between(from, to);
      const auto response = unit::step_response(step, scales_);
      return std::pair{std::move(step), response};
    });
  }

  /// @throws process::ProcessError  it was closed
  unit::UnitLink& open_link() {
    if (!link_) {
      throw process::ProcessError(device_ + ": this port is closed");
    }
    return *link_;
  }

  /// A work of one request or several, which other threads wait for.
  /// @throws std::invalid_argument  the unit has no such value
  /// @throws std::runtime_error     the unit refuses it now
  template <class Work>
  std::invoke_result_t<Work> in_turn(const Work& work) try {
    const py::gil_scoped_release released;
    const std::lock_guard turn(turn_);
    return work();
  } catch (const unit::UnitRefusal& refusal) {
    if (refusal.has_reason(link::Reason::out_of_range) ||
        refusal.has_reason(link::Reason::unknown_parameter)) {
      throw std::invalid_argument(refusal.what());
    }
    throw std::runtime_error(refusal.what());
  }

  py::dict columns_of(const unit::RecordedTrace& trace) const {
    py::dict columns;
    columns["time_s"] = unit::times_of(trace, scales_);
    const auto add = [&](link::Quantity quantity, std::int32_t link::TraceRecord::*code) {
      columns[scales_.column_of(quantity).c_str()] =
          unit::values_of(trace, scales_, quantity, code);
    };
    add(link::Quantity::friction_force, &link::TraceRecord::friction_force);
    add(link::Quantity::sliding_velocity, &link::TraceRecord::sliding_velocity);
    add(link::Quantity::amplitude, &link::TraceRecord::amplitude);
    columns[scales_.column_of(link::Quantity::target).c_str()] = unit::targets_of(trace, scales_);
    return columns;
  }

  static std::chrono::milliseconds milliseconds(double time_s) {
    constexpr double longest_s = 3600.0;
    if (!(time_s > 0.0 && time_s <= longest_s)) {
      throw py::value_error(
          fmt::format("patience_s is {}; allowed: above 0, at most {}", time_s, longest_s));
    }
    return std::chrono::milliseconds(static_cast<std::int64_t>(std::ceil(1e3 * time_s)));
  }

  template <class Answer, class Request>
  Answer ask(const Request& request, std::size_t parameter = 0,
             std::chrono::milliseconds work = {}) {
    return in_turn(
        [&] { return unit::require<Answer>(open_link(), scales_, request, parameter, work); });
  }

  template <class Answer, class Request>
  std::optional<Answer> ask_if_kept(const Request& request) {
    return in_turn([&] { return unit::ask_if_kept<Answer>(open_link(), scales_, request); });
  }

  std::string device_;
  std::chrono::milliseconds patience_;
  std::mutex turn_;
  std::optional<process::SerialPort> port_;
  std::optional<unit::UnitLink> link_;
  unit::UnitScales scales_;
};

py::list parameter_names() {
  py::list names;
  for (const app::ParameterLabel& label : parameter_labels) {
    names.append(label.name);
  }
  return names;
}

}  // namespace

void add_port(py::module_& module) {
  module.attr("parameter_names") = py::tuple(parameter_names());
  py::class_<Port>(module, "Port")
      .def(py::init<std::string, double>(), py::arg("device"), py::arg("patience_s"))
      .def(
          "close", &Port::close,
          "close(self)\n--\n\nFrees the device. The unit is left as it is: where it drives, it takes its host for "
          "silent\nafter its parameter host_timeout.")
      .def(
          "identity", &Port::identity,
          "identity(self)\n--\n\nVersion of the firmware, number of the design, name of the board and serial\n"
          "number, 0 where none was given; full_scales of what the unit reads, answers and takes.")
      .def(
          "status", &Port::status,
          "status(self)\n--\n\nWhat the unit measures and does in the present carrier period, in SI units:\n"
          "friction_force_N, sliding_velocity_m_per_s, drive_amplitude_N (of a transducer drive_amplitude_V),\n"
          "and target, a friction ratio, or target_force_N.")
      .def(
          "set_target", &Port::set_target, py::arg("target"),
          "set_target(self, target)\n--\n\nUntil reset: a friction ratio, or where holds_force a friction force [N].")
      .def_property_readonly("holds_force", &Port::holds_force,
                             "A friction force is the target, not a ratio.")
      .def(
          "step", &Port::step, py::arg("from_target"), py::arg("to_target"),
          "step(self, from_target, to_target)\n--\n\nHow the friction force goes from one target, once the loop has "
          "settled there\n(settled_before), to another, which stays. friction_force_before_N, friction_force_after_N,\n"
          "ripple_N; rise_s from 10 to 90 %, settling_s to 5 % and overshoot, parts of the step, None where\n"
          "there are none; limit and settling at the end; trace, lists by column: time_s since the new\n"
          "target, then as status().\n\nValueError: a target that the unit does not have, or twice the same. "
          "RuntimeError: the drive is\noff, a fault came, or the unit has no trace.")
      .def("stop", &Port::stop, "stop(self)\n--\n\nDrive to zero at once.")
      .def("restart", &Port::restart,
           "restart(self)\n--\n\nStarts the drive, from a stop, from a fault or from running.")
      .def(
          "confirm", &Port::confirm,
          "confirm(self)\n--\n\nAccepts the parameters in force, and saves them. Needs a stop first.")
      .def(
          "faults", &Port::faults,
          "faults(self)\n--\n\nThe last faults and the carrier periods in which they were found, the latest first.")
      .def(
          "exception", &Port::exception,
          "exception(self)\n--\n\nThe exception of the processor that ended the run before the last reset, or with a "
          "history the\nlast one ever: its number and what the registers held. None: there was none, or the image "
          "keeps\nnone.")
      .def(
          "history", &Port::history,
          "history(self)\n--\n\nOver all resets: boots, the cause of the last one, operation_s, watchdog_resets, "
          "exceptions,\nexception_boot, the number of the last boot after one, None without; saved, whether the "
          "flash\ntook it; and began_anew, whether the history before it could not be read. None: the unit keeps no "
          "history.")
      .def(
          "parameter", &Port::parameter, py::arg("name"),
          "parameter(self, name)\n--\n\nIts value, its range and what was compiled in; of a force in newtons.")
      .def("set_parameter", &Port::set_parameter, py::arg("name"), py::arg("value"),
           "set_parameter(self, name, value)\n--\n\nSaves a parameter. Needs a stop first.")
      .def(
          "tare", &Port::tare,
          "tare(self)\n--\n\nSaves what the force sensor reads without a force as the parameter force_offset: "
          "lift the\ncontact, and stop the drive. force_offset_before_N, force_offset_N, and standard_error_N of "
          "the\nlatter; readings_equal: all 256 were the same, as those of a sensor that is stuck. 1.3 s.\n\nRuntimeError, and nothing is changed: the unit drives, slides "
          "under load or has parameters that\nnobody has confirmed; the force is not steady to 0.1 % of "
          "friction_force; or the offset is out of\nthe parameter's range.");
}

}  // namespace sonoglide::python
