#include "host_sim/boards/unit/plant_traces.hpp"

#include <cstddef>

#include "firmware/app/field_parameters.hpp"
#include "host_sim/boards/unit/step_recorder.hpp"
#include "host_sim/boards/unit/unit_scales.hpp"
#include "host_sim/boards/unit/unit_words.hpp"
#include "host_sim/process/ending.hpp"
#include "host_sim/process/pipe.hpp"

namespace sonoglide::unit {
namespace {

/// What comes before a step that identification takes for steady.
constexpr std::uint16_t kept_before = 32;

/// However it ends, the unit is left without a drive; where no signal ends it, with the target of before.
class StoppedAtTheEnd {
 public:
  StoppedAtTheEnd(UnitLink& unit, std::uint32_t target)
      : unit_(unit), target_(target), undo_([&unit] { unit.send_stop(); }) {}
  ~StoppedAtTheEnd() {
    try {
      unit_.ask<link::Stopped>(link::Stop{});
      unit_.ask<link::TargetSet>(link::SetTarget{target_});
    } catch (const process::ProcessError&) {
      // It stops after its host_timeout, if it has one.
    }
  }
  StoppedAtTheEnd(const StoppedAtTheEnd&) = delete;
  StoppedAtTheEnd& operator=(const StoppedAtTheEnd&) = delete;

 private:
  UnitLink& unit_;
  std::uint32_t target_;
  process::Undo undo_;
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
  const UnitScales scales(unit);
  const auto before = require<link::Telemetry>(unit, scales, link::ReadTelemetry{});
  const StoppedAtTheEnd stopped(unit, before.target);
  StepRecorder recorder(unit, scales);
  std::vector<RecordedTrace> traces = {recorder.undriven()};
  const auto tell = [&] {
    progress(static_cast<double>(traces.size()) / static_cast<double>(targets.size()));
  };
  tell();
  {
    const process::Undisturbed whole;  // no start after the stop of a signal
    recorder.restart();
  }
  const auto count = [&](double target) {
    return scales.count_of_parameter(target_parameter, target);
  };
  recorder.set_target(count(targets.at(0)));
  recorder.settle();
  for (std::size_t i = 1; i < targets.size(); ++i) {
    traces.push_back(recorder.step(count(targets[i]), kept_before));
    recorder.settle();
    tell();
  }
  return traces;
}

}  // namespace sonoglide::unit
