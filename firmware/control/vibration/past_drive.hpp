/// The drive commands that have not yet shown all of their effect.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace sonoglide::control {

/// Commands from `Before` periods before the sampled one to the newest.
///
/// @tparam MaxDelay  largest delay, carrier periods from the end of a sampled period to the phase 0
///                   at which its answer acts
template <class Command, int MaxDelay, std::size_t Before = 1>
class PastDrive {
 public:
  explicit PastDrive(std::uint8_t delay) : delay_(delay) {}

  void clear() { commands_ = {}; }

  /// Of the sampled period, or of so many before it, up to `Before`; until a step appends its own.
  const Command& sampled(std::size_t before = 0) const { return commands_[Before - before]; }
  /// Of those that act between the sampled period and the answer's, in order; index < delay().
  const Command& under_way(std::size_t index) const { return commands_[Before + 1 + index]; }
  const Command& newest() const { return commands_[last()]; }
  /// With a MaxDelay of 0 or 1 there is no other.
  std::size_t delay() const { return MaxDelay <= 1 ? std::size_t{MaxDelay} : std::size_t{delay_}; }

  /// Of the period whose sample comes next, after the append.
  const Command& next() const { return commands_[Before]; }

  /// One call for each step, with its answer.
  void append(const Command& command) {
    for (std::size_t i = 0; i < last(); ++i) {
      commands_[i] = commands_[i + 1];
    }
    commands_[last()] = command;
  }

 private:
  std::size_t last() const { return delay() + Before; }

  std::uint8_t delay_;
  std::array<Command, MaxDelay + Before + 1> commands_{};
};

}  // namespace sonoglide::control
