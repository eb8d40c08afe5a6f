/// Counts the steps that the solvers take, however a carrier period is cut.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <utility>

namespace sonoglide::loop {

/// A carrier period has more steps than it may.
struct StepsRanOut : std::exception {
  explicit StepsRanOut(double last_s) : time_s(last_s) {}

  double time_s;  ///< since the run began, of the last step
};

class StepMeter {
 public:
  /// Steps between two calls of the pulse: some milliseconds to some tens of them.
  static constexpr std::uint64_t steps_per_pulse = 16384;

  /// @param limit  the most steps of a carrier period
  /// @param pulse  called now and then; what it throws ends the run. May be empty
  explicit StepMeter(std::uint64_t limit, std::function<void()> pulse = {})
      : limit_(limit), pulse_(std::move(pulse)) {}

  void begin_period() { count_ = 0; }
  std::uint64_t count() const { return count_; }

  /// One more step, which ended at a time since the run began.
  /// @throws StepsRanOut
  void take(double time_s) {
    if (++count_ > limit_) {
      throw StepsRanOut(time_s);
    }
    if (count_ % steps_per_pulse == 0 && pulse_) {
      pulse_();
    }
  }

 private:
  std::uint64_t limit_;
  std::function<void()> pulse_;
  std::uint64_t count_ = 0;
};

}  // namespace sonoglide::loop
