/// The sliding velocity within an interval.
#pragma once

namespace sonoglide::plant {

/// r = sliding_velocity + sliding_acceleration t, as plant::Interval says it.
struct LinearSliding {
  static constexpr bool varies = true;

  /// Change of r over a time, or over a group of times, in the unit of time of the acceleration.
  template <class Scalar, class Time>
  static constexpr Time change(Scalar acceleration, Time time) {
    return acceleration * time;
  }
};

/// r = sliding_velocity: an interval's sliding_acceleration is 0, and is not looked at.
struct ConstantSliding {
  static constexpr bool varies = false;

  /// The zero to add at no cost: x + -0 is x to a compiler, x + 0 is not.
  template <class Scalar, class Time>
  static constexpr Time change(Scalar /*acceleration*/, Time /*time*/) {
    return -Time{};
  }
};

}  // namespace sonoglide::plant
