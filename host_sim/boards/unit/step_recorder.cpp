#include "host_sim/boards/unit/step_recorder.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <thread>

#include "firmware/app/unit_names.hpp"
#include "firmware/control/interface/names.hpp"
#include "host_sim/boards/unit/unit_words.hpp"

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

}  // namespace

template <class Answer, class Request>
Answer StepRecorder::require(const Request& request, std::size_t parameter) {
  return unit::require<Answer>(unit_, scales_, request, parameter);
}

RecordedTrace StepRecorder::undriven() {
  require<link::Stopped>(link::Stop{});
  wait(calm);
  arm(link::Trigger::now, 0);
  return read();
}

void StepRecorder::restart() {
  require<link::Restarted>(link::Restart{});
}

RecordedTrace StepRecorder::step(std::uint32_t target, std::uint16_t before) {
  arm(link::Trigger::target, before);
  const std::uint32_t armed = telemetry().period;
  wait(calm);
  // An emulated board may take longer for the steps that come first.
  for (const auto end = Clock::now() + longest_wait;
       telemetry().period - armed < before && Clock::now() < end;) {
    std::this_thread::sleep_for(interval);
  }
  if (telemetry().period - armed < before) {
    throw UnitRefusal(fmt::format("the unit takes more than 5 s for {} steps", before));
  }
  set_target(target);
  return read();
}

RecordedStep StepRecorder::step_between(std::uint32_t first, std::uint32_t second) {
  require_target(first);
  require_target(second);
  if (first == second) {
    throw UnitRefusal("both targets are the same; allowed: two different ones",
                      link::Reason::out_of_range);
  }
  const auto before = static_cast<std::uint16_t>(steps_recorded() / 4);
  if (static_cast<control::State>(telemetry().state) == control::State::off) {
    throw UnitRefusal("the drive is off: restart it first");
  }
  set_target(first);
  const bool settled = settle();
  return {step(second, before), settled};
}

void StepRecorder::require_target(std::uint32_t target) {
  const auto told = require<link::ParameterValue>(
      link::ReadParameter{static_cast<std::uint8_t>(target_parameter)});
  if (target < told.lowest || target > told.highest) {
    throw UnitRefusal("target: allowed is " + range_of(told, scales_), link::Reason::out_of_range);
  }
}

std::uint16_t StepRecorder::steps_recorded() {
  constexpr std::uint16_t fewest = 8;
  const auto told = unit_.ask<link::TraceState>(link::ReadTraceState{});
  const auto* const state = std::get_if<link::TraceState>(&told);
  if (state == nullptr || state->records < fewest) {
    throw UnitRefusal("the unit has no trace of a step");
  }
  return state->records;
}

void StepRecorder::set_target(std::uint32_t target) {
  require<link::TargetSet>(link::SetTarget{target}, target_parameter);
}

void StepRecorder::arm(link::Trigger trigger, std::uint16_t before) {
  require<link::TraceArmed>(link::ArmTrace{static_cast<std::uint8_t>(trigger), before});
}

/// @throws UnitRefusal  it has found a fault
link::Telemetry StepRecorder::telemetry() {
  const auto told = require<link::Telemetry>(link::ReadTelemetry{});
  if (static_cast<control::State>(told.state) == control::State::fault) {
    throw UnitRefusal(
        fmt::format("the unit has stopped by the fault {}", app::fault_name(told.fault)));
  }
  return told;
}

void StepRecorder::wait(std::chrono::milliseconds time) {
  for (const auto end = Clock::now() + time; Clock::now() < end;) {
    telemetry();
    std::this_thread::sleep_for(interval);
  }
}

/// A loop that does not settle is one whose plant may be wanted: it is recorded as it is.
bool StepRecorder::settle() {
  auto settling = control::Settling::pending;
  for (const auto end = Clock::now() + longest_wait; Clock::now() < end;) {
    const link::Telemetry told = telemetry();
    settling = static_cast<control::Settling>(told.settling);
    if (static_cast<control::State>(told.state) != control::State::calibrating &&
        settling != control::Settling::pending) {
      break;
    }
    std::this_thread::sleep_for(interval);
  }
  wait(calm);
  return settling == control::Settling::settled;
}

RecordedTrace StepRecorder::read() {
  const auto end = Clock::now() + longest_trace;
  auto state = require<link::TraceState>(link::ReadTraceState{});
  while (static_cast<link::TracePhase>(state.phase) != link::TracePhase::whole) {
    if (Clock::now() > end) {
      throw UnitRefusal("the unit does not record: its trace is not whole after 20 s");
    }
    telemetry();
    std::this_thread::sleep_for(interval);
    state = require<link::TraceState>(link::ReadTraceState{});
  }
  return read_trace(unit_, state);
}

}  // namespace sonoglide::unit
