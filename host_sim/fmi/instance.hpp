/// An instance of an FMU, whatever the version of the interface.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/fmi/resources.hpp"
#include "host_sim/fmi/variables.hpp"
#include "host_sim/loop/plant/snapshot.hpp"
#include "host_sim/loop/stepped.hpp"

namespace sonoglide::fmi {

/// A call that the instance refuses; nothing has changed.
class CallError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Where an instance is on its way.
enum class Phase { instantiated, initialization, step, terminated };

/// When an importer lets a simulation begin and end.
struct TimeRange {
  double start_s = 0.0;
  double stop_s = std::numeric_limits<double>::infinity();
};

/// All of an instance but its place in memory.
struct State {
  Phase phase = Phase::instantiated;
  TimeRange range;
  double time_s = 0.0;  ///< of the last communication point
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

  /// @throws CallError  no carrier period can be counted from that start on, or it stops before
  void require_range(const TimeRange& range) const;
  /// @throws CallError  see require_range()
  void enter_initialization(const TimeRange& range);
  void exit_initialization();
  void terminate();
  void reset();

  /// Carries out the carrier periods that end in this step, be it none: the outputs then hold.
  /// @param may_stop_early  when a fault begins
  /// @return  whether it did so: time_s() is then before the end that was asked for
  /// @throws CallError  it does not begin here, has no length, or ends after the stop time
  /// @throws loop::ComputationError
  bool advance(double time_s, double duration_s, bool may_stop_early);
  double time_s() const { return now_.time_s; }

  State save();
  void restore(const State& state);
  /// As bytes for this FMU alone.
  std::vector<std::uint8_t> bytes_of(State state) const;
  /// @throws CallError  they are damaged, or of another FMU
  State state_of(const std::uint8_t* bytes, std::size_t count) const;

 private:
  SteppedScene& engine();
  /// @throws CallError  back: of another FMU
  void copy_parts(loop::StateCopy& copy, State& state) const;
  experiment::Experiment with_parameters() const;
  void require(bool allowed, const char* what) const;
  void require_step(double time_s, double duration_s) const;
  void require_input(const Variable& input, double value) const;

  Resources resources_;
  experiment::Experiment experiment_;
  std::vector<Variable> variables_;
  State now_;  ///< but for its engine
  std::optional<SteppedScene> engine_;
  std::map<std::uint32_t, std::string> texts_;
};

}  // namespace sonoglide::fmi
