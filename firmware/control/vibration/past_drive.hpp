/// The drive commands that have not yet shown all of their effect.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

template <class Scalar>
struct PastCommand {
  Scalar amplitude;    ///< base: the largest; below 0 the phase is turned by half a turn
  Scalar deviation;    ///< of the frequency from the start, relative to it, base 1/8
  std::int32_t steps;  ///< the same in steps of the frequency word
};

/// Commands from that of the period before the sampled one to the newest.
///
/// @tparam MaxDelay  largest delay, carrier periods from the end of a sampled period to the phase 0
///                   at which its answer acts
template <class Scalar, int MaxDelay>
class PastDrive {
 public:
  explicit PastDrive(std::uint8_t delay) : delay_(delay) {}

  const PastCommand<Scalar>& before() const { return commands_[0]; }
  /// Before the append of a step.
  const PastCommand<Scalar>& sampled() const { return commands_[1]; }
  /// Of those that act between the sampled period and the answer's, in order; index < delay().
  const PastCommand<Scalar>& under_way(std::size_t index) const { return commands_[2 + index]; }
  /// With a MaxDelay of 0 or 1 there is no other.
  std::size_t delay() const { return MaxDelay <= 1 ? MaxDelay : delay_; }

  /// Of the period whose sample comes next, after the append.
  const PastCommand<Scalar>& next() const { return commands_[1]; }

  /// One call for each step, with its answer.
  void append(const PastCommand<Scalar>& command) {
    const std::size_t last = delay() + 1;
    for (std::size_t i = 0; i < last; ++i) {
      commands_[i] = commands_[i + 1];
    }
    commands_[last] = command;
  }

 private:
  std::uint8_t delay_;
  std::array<PastCommand<Scalar>, MaxDelay + 2> commands_{};
};

}  // namespace sonoglide::control
