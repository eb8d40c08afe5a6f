#include "host_sim/unit/plant_traces.hpp"

#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "firmware/app/field_parameters.hpp"
#include "firmware/app/unit_names.hpp"
#include "firmware/control/interface/names.hpp"
#include "host_sim/process/pipe.hpp"
#include "host_sim/unit/unit_scales.hpp"
#include "host_sim/unit/unit_trace.hpp"
#include "host_sim/unit/unit_words.hpp"

namespace sonoglide::unit {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono_literals::operator""ms;

/// After a stop or a new target the natural mode may take so long to calm down.
constexpr auto calm = 100ms;
/// More than a loop takes to settle, or to learn its friction.
constexpr auto longest_wait = 5000ms;
constexpr auto longest_trace = 20000ms;
constexpr auto interval = 5ms;
constexpr std::size_t kept_before = 32;

class Recording {
 public:
  explicit Recording(UnitLink& unit) : unit_(unit), scales_(unit) {}
  ~Recording() {
    try {
      unit_.ask<link::Stopped>(link::Stop{});
    } catch (const process::ProcessError&) {
      // It stops by itself: its host is silent from here on.
    }
  }
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  RecordedTrace undriven() {
    require<link::Stopped>(link::Stop{});
    wait(calm);
    arm(link::Trigger::now, 0);
    return read();
  }

  void start(double target) {
    require<link::Restarted>(link::Restart{});
    set_target(target);
    settle();
  }

  RecordedTrace step(double target) {
    arm(link::Trigger::target, kept_before);
    // What comes before the step is kept first.
    wait(calm);
    set_target(target);
    RecordedTrace trace = read();
    settle();
    return trace;
  }

 private:
  template <class Answer, class Request>
  Answer require(const Request& request, std::size_t parameter = 0) {
    const auto result = unit_.ask<Answer>(request);
    if (const auto* refusal = std::get_if<link::Refusal>(&result)) {
      throw process::ProcessError("the unit refuses: " + words_of(*refusal, parameter, scales_));
    }
    return std::get<Answer>(result);
  }

  void set_target(double target) {
    constexpr auto parameter = static_cast<std::size_t>(app::Parameter::target);
    require<link::TargetSet>(link::SetTarget{scales_.count_of_parameter(parameter, target)},
                             parameter);
  }

  void arm(link::Trigger trigger, std::size_t before) {
    require<link::TraceArmed>(
        link::ArmTrace{static_cast<std::uint8_t>(trigger), static_cast<std::uint16_t>(before)});
  }

  /// @throws process::ProcessError  it has found a fault
  link::Telemetry telemetry() {
    const auto told = require<link::Telemetry>(link::ReadTelemetry{});
    if (static_cast<control::State>(told.state) == control::State::fault) {
      throw process::ProcessError(
          fmt::format("the unit has stopped by the fault {}", app::fault_name(told.fault)));
    }
    return told;
  }

  void wait(std::chrono::milliseconds time) {
    for (const auto end = Clock::now() + time; Clock::now() < end;) {
      telemetry();
      std::this_thread::sleep_for(interval);
    }
  }

  /// A loop that does not settle is one of those whose plant is to be found: it is recorded as it is.
  void settle() {
    for (const auto end = Clock::now() + longest_wait; Clock::now() < end;) {
      const link::Telemetry told = telemetry();
      const auto state = static_cast<control::State>(told.state);
      if (state != control::State::calibrating &&
          static_cast<control::Settling>(told.settling) != control::Settling::pending) {
        break;
      }
      std::this_thread::sleep_for(interval);
    }
    wait(calm);
  }

  RecordedTrace read() {
    const auto end = Clock::now() + longest_trace;
    auto state = require<link::TraceState>(link::ReadTraceState{});
    while (static_cast<link::TracePhase>(state.phase) != link::TracePhase::whole) {
      if (Clock::now() > end) {
        throw process::ProcessError("the unit does not record: its trace is not whole after 20 s");
      }
      telemetry();
      std::this_thread::sleep_for(interval);
      state = require<link::TraceState>(link::ReadTraceState{});
    }
    return {state.before, read_records(unit_, state)};
  }

  UnitLink& unit_;
  UnitScales scales_;
};

}  // namespace

bool has_design(UnitLink& unit, std::uint32_t controller) {
  const auto told = unit.ask<link::Identity>(link::ReadIdentity{});
  const auto* const identity = std::get_if<link::Identity>(&told);
  app::ParameterRanges ranges{};
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const auto value =
        unit.ask<link::ParameterValue>(link::ReadParameter{static_cast<std::uint8_t>(i)});
    const auto* const parameter = std::get_if<link::ParameterValue>(&value);
    if (parameter == nullptr) {
      return false;
    }
    ranges[i].lowest = parameter->lowest;
    ranges[i].highest = parameter->highest;
    ranges[i].preset = parameter->preset;
  }
  return identity != nullptr && identity->design == app::design_number(controller, ranges);
}

std::vector<RecordedTrace> record_plant(UnitLink& unit, const std::vector<double>& targets,
                                        const std::function<void(double)>& progress) {
  Recording recording(unit);
  std::vector<RecordedTrace> traces = {recording.undriven()};
  const auto tell = [&] {
    progress(static_cast<double>(traces.size()) / static_cast<double>(targets.size()));
  };
  tell();
  recording.start(targets.at(0));
  for (std::size_t i = 1; i < targets.size(); ++i) {
    traces.push_back(recording.step(targets[i]));
    tell();
  }
  return traces;
}

}  // namespace sonoglide::unit
