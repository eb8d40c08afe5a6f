/// An instance of an FMU, whatever the version of the interface.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/fmi/resources.hpp"
#include "host_sim/fmi/variables.hpp"
#include "host_sim/loop/snapshot.hpp"
#include "host_sim/stepped/engine.hpp"

namespace sonoglide::fmi {

/// A call that the instance refuses; nothing has changed.
class CallError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A step that the instance refuses: another one may follow.
class StepError : public CallError {
 public:
  using CallError::CallError;
};

/// Where an instance is on its way.
enum class Phase { instantiated, initialization, event, step, terminated };

/// The clock at a communication point; unused where the FMU has none.
struct Tick {
  bool due = true;       ///< it has not ticked here yet
  bool active = false;   ///< it ticks
  bool settled = false;  ///< what happened in this event mode has been taken over
};

/// All of an instance but its place in memory.
struct State {
  Phase phase = Phase::instantiated;
  double start_s = 0.0;
  std::uint64_t periods = 0;
  Tick tick;
  Inputs inputs;
  std::map<std::uint32_t, double> parameters;  ///< that were set, by their value references
  std::optional<loop::Snapshot> engine;
};

class Instance {
 public:
  /// @throws scene_file::SceneError, configure::ConfigurationError, CallError  these are no
  ///         resources of a usable FMU, or not those that the token tells of
  Instance(Resources resources, std::string_view token);

  const std::vector<Variable>& variables() const { return variables_; }
  /// @throws CallError  there is none
  const Variable& variable(std::uint32_t reference) const;

  void set(std::uint32_t reference, double value);
  /// Where nothing was computed yet, the initial value.
  Value get(std::uint32_t reference);
  /// The text of a get() that stays until the next one of the same variable.
  const std::string& get_text(std::uint32_t reference);

  void enter_initialization(double start_s);
  void exit_initialization();
  void terminate();
  void reset();

  // Event mode, of an FMU with a clock.

  bool has_clock() const { return resources_.content.clock; }
  std::uint64_t clock_resolution_Hz() const { return resolution_Hz_; }
  /// @throws CallError  the variable is no clock
  void require_clock(std::uint32_t reference) const;
  void enter_event_mode();
  /// @param active  false takes a tick back, with what it has done
  void set_clock(std::uint32_t reference, bool active);
  bool get_clock(std::uint32_t reference) const;
  /// Takes over what the tick has done, and ends the tick.
  void update_discrete_states();
  void enter_step_mode();

  /// With a clock a step is one carrier period, and the controller answers at the tick after it.
  /// @param may_stop_early  when a fault begins
  /// @return  whether it did so: time_s() is then before the end that was asked for
  /// @throws StepError  it is no whole number of carrier periods, or does not begin here
  /// @throws CallError  the clock has not ticked
  /// @throws loop::ComputationError
  bool advance(double time_s, double duration_s, bool may_stop_early);
  double time_s() const;
  double period_s() const { return period_s_; }

  State save();
  void restore(const State& state);
  /// As bytes for this FMU alone.
  std::vector<std::uint8_t> bytes_of(const State& state) const;
  /// @throws CallError  they are damaged, or of another FMU
  State state_of(const std::uint8_t* bytes, std::size_t count) const;

 private:
  Engine& engine();
  scene::Scene scene_with_parameters() const;
  void require(bool allowed, const char* what) const;
  void require_step(double time_s, double duration_s) const;
  void require_input(const Variable& input, double value) const;
  loop::Snapshot engine_snapshot();
  void restore_engine(const loop::Snapshot& snapshot);
  /// The clock ticks, and the engine has not answered yet the period that ended here.
  bool awaits_answer() const;
  /// Such that it can be taken back.
  void answer();
  /// The engine as it was before its answer.
  void take_back_answer();

  Resources resources_;
  scene::Scene scene_;
  std::vector<Variable> variables_;
  double period_s_;
  std::uint64_t resolution_Hz_ = 0;  ///< with a clock
  State now_;                        ///< but for its engine
  std::optional<Engine> engine_;
  std::optional<loop::Snapshot> unanswered_;  ///< the engine before its answer to this tick
  std::map<std::uint32_t, std::string> texts_;
};

}  // namespace sonoglide::fmi
