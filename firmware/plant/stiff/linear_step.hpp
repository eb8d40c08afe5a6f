/// One step in closed form: the motion inside it, and its integrals.
#pragma once

#include <utility>

#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/state.hpp"
#include "firmware/plant/stiff/linear_motion.hpp"

namespace sonoglide::plant {

/// A linear motion over an interval, in which the friction holds.
template <class Model>
class LinearStep {
 public:
  using Scalar = typename Model::Scalar;

  /// begin: time since the interval began of which `interval` is the last part.
  LinearStep(const Model& model, const IntervalOf<Model>& interval, Scalar begin,
             const LinearMotion<Scalar>& motion, Scalar friction, const State<Scalar>& start)
      : model_(model),
        interval_(interval),
        begin_(begin),
        motion_(motion),
        friction_(friction),
        start_(start.displacement) {}

  Scalar begin() const { return begin_; }
  Scalar length() const { return interval_.duration; }
  State<Scalar> at(Scalar offset) const {
    const Point<Scalar> point = motion_.at(offset);
    return {point.displacement, point.velocity, friction_};
  }
  State<Scalar> end() const { return at(length()); }

  /// Displacement of the contact over the step.
  Scalar travel() const {
    return model_.contact_velocity(slid(), motion_.at(length()).displacement - start_);
  }

  Scalar friction_integral() const { return friction_ * length(); }
  Scalar friction_work() const { return friction_ * travel(); }
  Scalar sliding_work() const { return friction_ * slid(); }
  MotionIntegrals<Scalar> motion_integrals() const { return motion_.integrals(length()); }

  /// Of t v, t since the step began.
  Scalar velocity_moment() const { return motion_.velocity_moment(length()); }

  /// Of v cos(phase + t) and of v sin(phase + t).
  auto demodulated(Scalar phase) const { return motion_.demodulated(length(), phase); }

 private:
  Scalar slid() const {
    return length() *
           (interval_.sliding_velocity +
            Model::Sliding::change(interval_.sliding_acceleration, numeric::half(length())));
  }

  const Model& model_;
  const IntervalOf<Model>& interval_;
  Scalar begin_;
  const LinearMotion<Scalar>& motion_;
  Scalar friction_;
  Scalar start_;
};

/// A step of a part of an interval, seen from the beginning of the interval.
template <class Step>
class ShiftedStep {
 public:
  ShiftedStep(const Step& step, decltype(std::declval<Step>().begin()) shift)
      : step_(step), shift_(shift) {}

  auto begin() const { return step_.begin() + shift_; }
  auto length() const { return step_.length(); }
  template <class Scalar>
  auto at(Scalar offset) const {
    return step_.at(offset);
  }
  auto friction_integral() const { return step_.friction_integral(); }
  auto friction_work() const { return step_.friction_work(); }
  auto sliding_work() const { return step_.sliding_work(); }
  auto motion_integrals() const { return step_.motion_integrals(); }

 private:
  const Step& step_;
  decltype(std::declval<Step>().begin()) shift_;
};

/// Shows the steps of a part of an interval.
template <class Observer, class Scalar>
struct ShiftedObserver {
  Observer& observer;
  Scalar shift;

  template <class Step>
  void operator()(const Step& step) {
    observer(ShiftedStep<Step>(step, shift));
  }
};

}  // namespace sonoglide::plant
