#include "host_sim/fmi/instance.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

namespace sonoglide::fmi {
namespace {

/// Of a carrier period, in a communication point: whoever adds up steps adds up their rounding.
constexpr double point_tolerance = 1e-2;
/// What an importer may give for a carrier frequency, as in a scene.
constexpr double lowest_frequency_Hz = 1e-3;
constexpr double highest_frequency_Hz = 1e9;

experiment::Experiment read_scene(const std::string& text,
                                  const std::vector<std::string>& overrides = {}) {
  return experiment::read_text(text, Resources::scene_name, overrides);
}

Inputs initial_inputs(const std::vector<Variable>& variables) {
  Inputs inputs;
  for (const Variable& variable : variables) {
    if (variable.input != nullptr) {
      inputs.*variable.input = std::get<double>(variable.start);
    }
  }
  return inputs;
}

}  // namespace

Instance::Instance(Resources resources, std::string_view token)
    : resources_(std::move(resources)), experiment_(read_scene(resources_.scene)) {
  if (token != resources_.token) {
    throw CallError(
        fmt::format("the token is \"{}\"; that of this FMU is \"{}\"", token, resources_.token));
  }
  loop::require_usable(experiment_.plant, resources_.kind);
  variables_ = fmi::variables(experiment_, resources_.kind);
  now_.inputs = initial_inputs(variables_);
}

const Variable& Instance::variable(std::uint32_t reference) const {
  if (reference >= variables_.size()) {
    throw CallError(fmt::format("there is no variable of value reference {}; allowed: 0 to {}",
                                reference, variables_.size() - 1));
  }
  return variables_[reference];
}

void Instance::require(bool allowed, const char* what) const {
  if (!allowed) {
    throw CallError(fmt::format("{} is not allowed {}", what,
                                now_.phase == Phase::instantiated     ? "before initialization"
                                : now_.phase == Phase::initialization ? "in initialization mode"
                                : now_.phase == Phase::step           ? "in step mode"
                                                                      : "after the end"));
  }
}

void Instance::set(std::uint32_t reference, double value) {
  const Variable& wanted = variable(reference);
  if (wanted.role == Role::parameter) {
    require(now_.phase == Phase::instantiated || now_.phase == Phase::initialization,
            "to set a parameter");
    now_.parameters[reference] = value;
    engine_.reset();
    return;
  }
  if (wanted.role != Role::input) {
    throw CallError(fmt::format("{} cannot be set", wanted.name));
  }
  require_input(wanted, value);
  (wanted.input != nullptr ? now_.inputs.*wanted.input : now_.inputs.seen.*wanted.seen) = value;
}

void Instance::require_input(const Variable& input, double value) const {
  require(now_.phase != Phase::terminated, "to set an input");
  if (!std::isfinite(value)) {
    throw CallError(fmt::format("{} is {}; allowed: a finite number", input.name, value));
  }
  if (input.input == &Inputs::target && !(value >= 0.0 && value <= input.highest)) {
    throw CallError(fmt::format("{} is {}; allowed: 0 to {}", input.name, value, input.highest));
  }
  if (input.input == &Inputs::drive_frequency_Hz &&
      !(value >= lowest_frequency_Hz && value <= highest_frequency_Hz)) {
    throw CallError(fmt::format("{} is {} Hz; allowed: {} to {} Hz", input.name, value,
                                lowest_frequency_Hz, highest_frequency_Hz));
  }
}

Value Instance::get(std::uint32_t reference) {
  const Variable& wanted = variable(reference);
  switch (wanted.role) {
    case Role::time:
      return time_s();
    case Role::parameter: {
      const auto set = now_.parameters.find(reference);
      if (set == now_.parameters.end()) {
        return wanted.start;
      }
      return wanted.type() == Type::int32 ? Value(static_cast<std::int32_t>(set->second))
                                          : Value(set->second);
    }
    case Role::input:
      return wanted.input != nullptr ? now_.inputs.*wanted.input : now_.inputs.seen.*wanted.seen;
    case Role::output:
      break;
  }
  return wanted.output(engine());
}

const std::string& Instance::get_text(std::uint32_t reference) {
  return texts_[reference] = std::get<std::string>(get(reference));
}

void Instance::require_range(const TimeRange& range) const {
  const double magnitude_s = std::abs(range.start_s);
  const double spacing_s =
      std::nextafter(magnitude_s, std::numeric_limits<double>::infinity()) - magnitude_s;
  if (!(spacing_s <= point_tolerance / experiment_.plant.drive->frequency_Hz)) {
    throw CallError(
        fmt::format("the start time is {} s; allowed: a finite number whose rounding "
                    "is below {} carrier periods",
                    range.start_s, point_tolerance));
  }
  if (!(range.stop_s >= range.start_s)) {
    throw CallError(fmt::format("the stop time is {} s; allowed: from the start time, {} s, on",
                                range.stop_s, range.start_s));
  }
}

void Instance::enter_initialization(const TimeRange& range) {
  require(now_.phase == Phase::instantiated, "to enter initialization mode");
  require_range(range);
  now_.range = range;
  now_.time_s = range.start_s;
  now_.phase = Phase::initialization;
}

void Instance::exit_initialization() {
  require(now_.phase == Phase::initialization, "to leave initialization mode");
  engine();
  now_.phase = Phase::step;
}

void Instance::terminate() {
  require(now_.phase == Phase::step, "to terminate");
  now_.phase = Phase::terminated;
}

void Instance::reset() {
  now_ = State();
  now_.inputs = initial_inputs(variables_);
  engine_.reset();
}

void Instance::require_step(double time_s, double duration_s) const {
  require(now_.phase == Phase::step, "a step");
  const double period_s = 1.0 / experiment_.plant.drive->frequency_Hz;
  if (!(std::abs(time_s - now_.time_s) <= point_tolerance * period_s)) {
    throw CallError(
        fmt::format("the communication point is {} s; allowed: {} s, where the last "
                    "step ended",
                    time_s, now_.time_s));
  }
  const double most_s = (loop::endless_periods - 1.0) * period_s;
  if (!(duration_s > 0.0 && time_s + duration_s - now_.range.start_s <= most_s)) {
    throw CallError(
        fmt::format("the communication step is {} s; allowed: above 0 s, up to {} s after "
                    "the start",
                    duration_s, most_s));
  }
  // Importers that add up steps, or call times 1e-5 s apart equal, may begin one step too many.
  const double end_s = time_s + duration_s;
  if (end_s > now_.range.stop_s + (1.0 + point_tolerance) * period_s) {
    throw CallError(
        fmt::format("the communication step ends at {} s; allowed: up to {} s, which is "
                    "set as the stop time",
                    end_s, now_.range.stop_s));
  }
}

bool Instance::advance(double time_s, double duration_s, bool may_stop_early) {
  require_step(time_s, duration_s);
  const auto ends_by = [this](double until_s) {
    const loop::CarrierClock period = engine().next_period(now_.inputs);
    return period.end_s() - (until_s - now_.range.start_s) <= point_tolerance * period.period_s();
  };
  const double end_s = time_s + duration_s;
  while (ends_by(end_s)) {
    const double period_end_s = now_.range.start_s + engine().next_period(now_.inputs).end_s();
    engine().advance(now_.inputs);
    if (may_stop_early && engine().fault_began() && ends_by(end_s)) {
      now_.time_s = period_end_s;
      return true;
    }
  }
  now_.time_s = end_s;
  return false;
}

SteppedScene& Instance::engine() {
  if (!engine_) {
    engine_.emplace(with_parameters(), resources_.kind);
  }
  return *engine_;
}

experiment::Experiment Instance::with_parameters() const {
  std::vector<std::string> overrides;
  for (const auto& [reference, value] : now_.parameters) {
    const Variable& parameter = variables_[reference];
    overrides.push_back(parameter.type() == Type::int32
                            ? fmt::format("{}={}", parameter.name, static_cast<std::int32_t>(value))
                            : fmt::format("{}={}", parameter.name, value));
  }
  return read_scene(resources_.scene, overrides);
}

}  // namespace sonoglide::fmi
