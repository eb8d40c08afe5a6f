/// The target of an image whose carrier periods change their length, compiled in.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/board.hpp"

namespace sonoglide::app {

/// Time in carrier periods of the start, of a drive whose frequency is a word: each period counts
/// by the word of the start over its own. Rounded to 2^-20 periods in each.
class ElapsedPeriods {
 public:
  static constexpr int fraction_bits = 20;

  /// @param start_word  frequency of the start in steps of the word; below 2^31
  explicit ElapsedPeriods(std::uint32_t start_word) : start_word_(start_word) {}

  /// @param steps  of the period's word from the start
  void add(std::int32_t steps) {
    const auto word = static_cast<std::uint64_t>(std::int64_t{start_word_} + steps);
    elapsed_ += ((std::uint64_t{start_word_} << fraction_bits) + word / 2) / word;
  }

  /// With fraction_bits.
  std::uint64_t value() const { return elapsed_; }

 private:
  std::uint32_t start_word_;
  std::uint64_t elapsed_ = 0;
};

/// A target, and the time from which it is in force.
template <class Scalar>
struct TimedTarget {
  /// In force from the first sample at this time or after, see ElapsedPeriods.
  std::uint64_t elapsed;
  Scalar target;  ///< see Controller::set_target
};

/// The targets of a run, and the frequency word that it begins with.
template <class Scalar, std::size_t Count>
struct TimedTargets {
  std::uint32_t start_word;
  TimedTarget<Scalar> steps[Count];
};

/// See first_target of TargetStep.
template <class Scalar, std::size_t Count>
constexpr Scalar first_target(const TimedTargets<Scalar, Count>& targets) {
  return targets.steps[0].target;
}

/// Walks through targets of rising time, one call for each carrier period.
template <class Scalar, std::size_t Count>
class TimedSchedule {
 public:
  explicit TimedSchedule(const TimedTargets<Scalar, Count>& targets)
      : targets_(targets), elapsed_(targets.start_word) {}

  /// Sets the target of the carrier period whose sample comes next.
  template <class Controller>
  void advance(Controller& controller) {
    elapsed_.add(controller.next_frequency());
    while (next_ < Count && targets_.steps[next_].elapsed <= elapsed_.value()) {
      controller.set_target(targets_.steps[next_++].target);
    }
  }

  /// Takes a sample: these targets do not depend on it.
  template <class Board>
  static constexpr void pass(const hal::Sample& /*sample*/, Board& /*board*/) {}

 private:
  const TimedTargets<Scalar, Count>& targets_;
  ElapsedPeriods elapsed_;
  std::size_t next_ = 0;
};

template <class Board = void, class Scalar, std::size_t Count>
TimedSchedule<Scalar, Count> schedule_of(const TimedTargets<Scalar, Count>& targets) {
  return TimedSchedule<Scalar, Count>(targets);
}

}  // namespace sonoglide::app
