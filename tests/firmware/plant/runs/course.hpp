/// An interval in words: lasting(7.0).driven(1.3).sliding(0.4).
#pragma once

#include "firmware/plant/state.hpp"

namespace sonoglide::plant {

/// Numbers in double, rounded to a solver's scalar where they enter it. What is not said is 0.
class Course {
 public:
  constexpr explicit Course(double duration) : interval_{{0.0, duration, 0.0, 0.0, 0.0}} {}

  constexpr Course from_phase(double phase) const {
    Course course = *this;
    course.interval_.phase_begin = phase;
    return course;
  }
  constexpr Course driven(double amplitude) const {
    Course course = *this;
    course.interval_.drive_amplitude = amplitude;
    return course;
  }
  constexpr Course sliding(double velocity) const {
    Course course = *this;
    course.interval_.sliding_velocity = velocity;
    return course;
  }
  constexpr Course accelerating(double acceleration) const {
    Course course = *this;
    course.interval_.sliding_acceleration = acceleration;
    return course;
  }
  /// The force on a load.
  constexpr Course pushed(double force, double force_rate = 0.0) const {
    Course course = *this;
    course.interval_.load_force = force;
    course.interval_.load_force_rate = force_rate;
    return course;
  }

  constexpr double duration() const { return interval_.duration; }

  template <class Scalar>
  constexpr operator Interval<Scalar>() const {
    return {static_cast<Scalar>(interval_.phase_begin), static_cast<Scalar>(interval_.duration),
            static_cast<Scalar>(interval_.drive_amplitude),
            static_cast<Scalar>(interval_.sliding_velocity),
            static_cast<Scalar>(interval_.sliding_acceleration)};
  }
  template <class Scalar>
  constexpr operator LoadedInterval<Scalar>() const {
    return {Interval<Scalar>(*this), static_cast<Scalar>(interval_.load_force),
            static_cast<Scalar>(interval_.load_force_rate)};
  }

 private:
  LoadedInterval<double> interval_;
};

constexpr Course lasting(double duration) {
  return Course(duration);
}

}  // namespace sonoglide::plant
