/// The targets of an image: compiled in, or all from its host.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/board.hpp"

namespace sonoglide::app {

/// A target, and the carrier period from which it is in force.
template <class Scalar>
struct TargetStep {
  std::uint32_t period;  ///< in force from the sample of this carrier period on, counted from 0
  Scalar target;         ///< see Controller::set_target
};

/// In force from the start of a unit, until its host sets another.
template <class Scalar, std::size_t Count>
constexpr Scalar first_target(const TargetStep<Scalar> (&steps)[Count]) {
  return steps[0].target;
}

/// Walks through steps of rising period, one call for each carrier period.
template <class Scalar, std::size_t Count>
class TargetSchedule {
 public:
  explicit TargetSchedule(const TargetStep<Scalar> (&steps)[Count]) : steps_(steps) {}

  /// Sets the target of the next carrier period.
  template <class Controller>
  void advance(Controller& controller) {
    while (next_ < Count && steps_[next_].period <= period_) {
      controller.set_target(steps_[next_++].target);
    }
    ++period_;
  }

  /// Takes a sample: these targets do not depend on it.
  template <class Board>
  static constexpr void pass(const hal::Sample& /*sample*/, Board& /*board*/) {}

 private:
  const TargetStep<Scalar> (&steps_)[Count];
  std::size_t next_ = 0;
  std::uint32_t period_ = 0;
};

template <class Board = void, class Scalar, std::size_t Count>
TargetSchedule<Scalar, Count> schedule_of(const TargetStep<Scalar> (&steps)[Count]) {
  return TargetSchedule<Scalar, Count>(steps);
}

/// What of a unit's target is not its host's: nothing. TextureCourse stands in its place where the unit has
/// a texture. In each carrier period move() comes first, then the orders, then aim(), then pass().
struct OrderedTargets {
  /// To the place of the sample that comes.
  template <class Controller>
  static constexpr void move(const Controller& /*controller*/) {}
  /// Sets the target of the step, where it is not an order.
  template <class Controller>
  static constexpr void aim(Controller& /*controller*/) {}
  /// Takes a sample.
  template <class Board>
  static constexpr void pass(const hal::Sample& /*sample*/, Board& /*board*/) {}
  /// Whether an ordered target is none of the controller's.
  template <class Scalar>
  static constexpr bool takes(Scalar /*ordered*/) {
    return false;
  }
};

/// Of the targets that are compiled in. See TextureTargets for others.
template <class Board, class Targets>
constexpr OrderedTargets course_of(const Targets& /*targets*/) {
  return {};
}

}  // namespace sonoglide::app
