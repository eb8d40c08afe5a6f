#include "host_sim/fmi/instance.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <utility>

#include "host_sim/process/checksum.hpp"
#include "host_sim/scene_file/reader.hpp"

namespace sonoglide::fmi {
namespace {

/// Of a carrier period, in the length of a step.
constexpr double step_tolerance = 1e-6;
/// Of a carrier period, in a communication point: whoever adds up steps adds up their rounding.
constexpr double point_tolerance = 1e-2;

scene::Scene read_scene(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return scene_file::read_text(text, Resources::scene_name, overrides);
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

std::string_view as_text(const std::uint8_t* bytes, std::size_t count) {
  return {reinterpret_cast<const char*>(bytes), count};
}

}  // namespace

Instance::Instance(Resources resources, std::string_view token)
    : resources_(std::move(resources)), scene_(read_scene(resources_.scene)) {
  if (token != resources_.token) {
    throw CallError(
        fmt::format("the token is \"{}\"; that of this FMU is \"{}\"", token, resources_.token));
  }
  stepped::require_usable(scene_, resources_.content.kind);
  variables_ = fmi::variables(scene_, resources_.content);
  period_s_ = 1.0 / scene_.drive->frequency_Hz;
  if (has_clock()) {
    resolution_Hz_ = fmi::clock_resolution_Hz(scene_);
  }
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
                                : now_.phase == Phase::event          ? "in event mode"
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
  take_back_answer();
  (wanted.input != nullptr ? now_.inputs.*wanted.input : now_.inputs.seen.*wanted.seen) = value;
}

void Instance::require_input(const Variable& input, double value) const {
  require(now_.phase != Phase::terminated, "to set an input");
  const bool may_change = now_.phase < Phase::event || now_.tick.active;
  if (has_clock() && !may_change) {
    throw CallError(fmt::format(
        "{} belongs to the clock; allowed: to set it before the end of initialization mode, or "
        "while the clock is active",
        input.name));
  }
  if (!std::isfinite(value)) {
    throw CallError(fmt::format("{} is {}; allowed: a finite number", input.name, value));
  }
  if (input.input == &Inputs::target_friction_ratio && !(value >= 0.0 && value <= 1.0)) {
    throw CallError(fmt::format("{} is {}; allowed: 0 to 1", input.name, value));
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
    case Role::clock:
      return now_.tick.active;
    case Role::output:
      break;
  }
  if (wanted.clocked == Clocked::answer && awaits_answer()) {
    answer();
  }
  return wanted.output(engine());
}

const std::string& Instance::get_text(std::uint32_t reference) {
  return texts_[reference] = std::get<std::string>(get(reference));
}

void Instance::enter_initialization(double start_s) {
  require(now_.phase == Phase::instantiated, "to enter initialization mode");
  now_.start_s = start_s;
  now_.phase = Phase::initialization;
}

void Instance::exit_initialization() {
  require(now_.phase == Phase::initialization, "to leave initialization mode");
  engine();
  now_.phase = has_clock() ? Phase::event : Phase::step;
}

void Instance::require_clock(std::uint32_t reference) const {
  if (variable(reference).role != Role::clock) {
    throw CallError(fmt::format("{} is no Clock", variable(reference).name));
  }
}

void Instance::enter_event_mode() {
  if (!has_clock()) {
    throw CallError("event mode: this FMU has none");
  }
  require(now_.phase == Phase::step, "to enter event mode");
  now_.phase = Phase::event;
  now_.tick.settled = false;
}

void Instance::set_clock(std::uint32_t reference, bool active) {
  require_clock(reference);
  require(now_.phase == Phase::event, "to set the clock");
  if (active && !now_.tick.due) {
    throw CallError(fmt::format(
        "the clock has ticked at {} s; allowed: once at each communication point", time_s()));
  }
  if (!active) {
    take_back_answer();
  }
  now_.tick.active = active;
  now_.tick.settled = false;
}

bool Instance::get_clock(std::uint32_t reference) const {
  require_clock(reference);
  return now_.tick.active;
}

void Instance::update_discrete_states() {
  require(now_.phase == Phase::event, "to update discrete states");
  if (now_.tick.active) {
    if (awaits_answer()) {
      engine().run_controller(now_.inputs);
    }
    unanswered_.reset();
    now_.tick.due = false;
    now_.tick.active = false;
  }
  now_.tick.settled = true;
}

void Instance::enter_step_mode() {
  require(now_.phase == Phase::event, "to enter step mode");
  if (!now_.tick.settled) {
    throw CallError("to enter step mode is not allowed before fmi3UpdateDiscreteStates");
  }
  now_.phase = Phase::step;
}

bool Instance::awaits_answer() const {
  return now_.tick.active && !unanswered_ && now_.periods > 0;
}

void Instance::answer() {
  unanswered_ = engine_snapshot();
  engine().run_controller(now_.inputs);
}

void Instance::take_back_answer() {
  if (unanswered_) {
    restore_engine(*unanswered_);
    unanswered_.reset();
  }
}

void Instance::terminate() {
  require(now_.phase == Phase::event || now_.phase == Phase::step, "to terminate");
  now_.phase = Phase::terminated;
}

void Instance::reset() {
  now_ = State();
  now_.inputs = initial_inputs(variables_);
  engine_.reset();
  unanswered_.reset();
}

double Instance::time_s() const {
  return now_.start_s + static_cast<double>(now_.periods) * period_s_;
}

void Instance::require_step(double time_s, double duration_s) const {
  require(now_.phase == Phase::step, "a step");
  if (has_clock() && now_.tick.due) {
    throw CallError(fmt::format("the clock has not ticked at {} s; allowed: a step after the tick",
                                this->time_s()));
  }
  const double periods = std::round(duration_s / period_s_);
  const double left =
      has_clock() ? 1.0 : stepped::endless_periods - 1.0 - static_cast<double>(now_.periods);
  if (!(periods >= 1.0 && periods <= left) ||
      std::abs(duration_s / period_s_ - periods) > step_tolerance * periods) {
    throw StepError(
        fmt::format("the communication step of {} s is {} carrier periods; allowed: {} {} s",
                    duration_s, duration_s / period_s_,
                    has_clock() ? "the clock's interval," : "a whole number of", period_s_));
  }
  if (!(std::abs(time_s - this->time_s()) <= point_tolerance * period_s_)) {
    throw StepError(
        fmt::format("the communication point is {} s; allowed: {} s, where the last "
                    "step ended",
                    time_s, this->time_s()));
  }
}

bool Instance::advance(double time_s, double duration_s, bool may_stop_early) {
  require_step(time_s, duration_s);
  if (has_clock()) {
    engine().run_plant(now_.inputs);
    ++now_.periods;
    now_.tick.due = true;
    return false;
  }
  const auto count = static_cast<std::uint64_t>(std::round(duration_s / period_s_));
  for (std::uint64_t done = 1; done <= count; ++done) {
    engine().advance(now_.inputs);
    ++now_.periods;
    if (may_stop_early && done < count && engine().fault_began()) {
      return true;
    }
  }
  return false;
}

State Instance::save() {
  State state = now_;
  if (unanswered_) {
    state.engine = unanswered_;  // Whoever restores it answers the tick anew.
  } else if (engine_) {
    state.engine = engine_snapshot();
  }
  return state;
}

loop::Snapshot Instance::engine_snapshot() {
  loop::SnapshotWriter writer;
  engine().save(writer);
  return writer.take();
}

void Instance::restore_engine(const loop::Snapshot& snapshot) {
  loop::SnapshotReader reader(snapshot);
  engine().restore(reader);
  if (!reader.over()) {
    throw CallError("the state that is to be restored is too long");
  }
}

void Instance::restore(const State& state) {
  const bool same_numbers = state.parameters == now_.parameters;
  now_ = state;
  now_.engine.reset();
  unanswered_.reset();
  if (!state.engine || !same_numbers) {
    engine_.reset();
  }
  if (state.engine) {
    restore_engine(*state.engine);
  }
}

std::vector<std::uint8_t> Instance::bytes_of(const State& state) const {
  loop::SnapshotWriter writer;
  writer.put(process::checksum(resources_.token));
  writer.put(state.phase);
  writer.put(state.start_s);
  writer.put(state.periods);
  writer.put(state.tick);
  writer.put(state.inputs);
  writer.put(state.parameters.size());
  for (const auto& [reference, value] : state.parameters) {
    writer.put(reference);
    writer.put(value);
  }
  writer.put(state.engine.has_value());
  if (state.engine) {
    writer.put(state.engine->size());
    for (const std::byte byte : *state.engine) {
      writer.put(byte);
    }
  }
  const loop::Snapshot snapshot = writer.take();
  std::vector<std::uint8_t> bytes(snapshot.size() + sizeof(std::uint64_t));
  std::memcpy(bytes.data(), snapshot.data(), snapshot.size());
  const std::uint64_t sum = process::checksum(as_text(bytes.data(), snapshot.size()));
  std::memcpy(bytes.data() + snapshot.size(), &sum, sizeof(sum));
  return bytes;
}

State Instance::state_of(const std::uint8_t* bytes, std::size_t count) const {
  std::uint64_t sum = 0;
  if (count < sizeof(sum)) {
    throw CallError("the serialized state is too short");
  }
  const std::size_t rest = count - sizeof(sum);
  std::memcpy(&sum, bytes + rest, sizeof(sum));
  if (sum != process::checksum(as_text(bytes, rest))) {
    throw CallError("the serialized state is damaged");
  }
  loop::Snapshot snapshot(rest);
  std::memcpy(snapshot.data(), bytes, rest);
  loop::SnapshotReader reader(snapshot);
  std::uint64_t token = 0;
  reader.get(token);
  if (token != process::checksum(resources_.token)) {
    throw CallError("the serialized state is that of another FMU");
  }
  State state;
  reader.get(state.phase);
  reader.get(state.start_s);
  reader.get(state.periods);
  reader.get(state.tick);
  reader.get(state.inputs);
  std::size_t parameters = 0;
  reader.get(parameters);
  for (; parameters > 0; --parameters) {
    std::uint32_t reference = 0;
    reader.get(reference);
    reader.get(state.parameters[reference]);
  }
  bool has_engine = false;
  reader.get(has_engine);
  if (has_engine) {
    std::size_t size = 0;
    reader.get(size);
    state.engine.emplace(size);
    for (std::byte& byte : *state.engine) {
      reader.get(byte);
    }
  }
  return state;
}

Engine& Instance::engine() {
  if (!engine_) {
    engine_.emplace(scene_with_parameters(), resources_.content.kind);
  }
  return *engine_;
}

scene::Scene Instance::scene_with_parameters() const {
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
