/// The sample of "How to add a solver": explicit Euler.
#pragma once

#include <cstdint>

#include "firmware/friction/vibration.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/outcome.hpp"
#include "firmware/plant/state.hpp"

namespace sonoglide::plant {

/// One step, y -> y + h v, v -> v + h a. Its integrals take the values at its beginning.
template <class Model>
class EulerStep {
 public:
  using Scalar = typename Model::Scalar;

  EulerStep(const Model& model, const State<Scalar>& from, Scalar drive, Scalar sliding_velocity,
            Scalar begin, Scalar length)
      : model_(model),
        from_(from),
        drive_(drive),
        sliding_velocity_(sliding_velocity),
        begin_(begin),
        length_(length) {}

  Scalar begin() const { return begin_; }
  Scalar length() const { return length_; }
  State<Scalar> at(Scalar offset) const {
    const Scalar velocity = from_.velocity + offset * model_.acceleration(drive_, from_);
    const Scalar rate =
        model_.law.rate(model_.contact_velocity(sliding_velocity_, from_.velocity), from_.friction);
    return {from_.displacement + offset * from_.velocity, velocity,
            model_.law.friction(model_.contact_velocity(sliding_velocity_, velocity),
                                from_.friction + offset * rate)};
  }
  Scalar friction_integral() const { return length_ * from_.friction; }
  Scalar friction_work() const {
    return length_ * model_.friction_power(sliding_velocity_, from_.velocity, from_.friction);
  }
  Scalar sliding_work() const { return friction_integral() * sliding_velocity_; }
  MotionIntegrals<Scalar> motion_integrals() const {
    MotionIntegrals<Scalar> sum;
    sum.add(length_, drive_, from_.displacement, from_.velocity);
    sum.damping_work = model_.damping_force(sum.velocity_square);
    return sum;
  }

 private:
  const Model& model_;
  State<Scalar> from_;
  Scalar drive_;
  Scalar sliding_velocity_;
  Scalar begin_;
  Scalar length_;
};

/// First order in the step. It does not look for reversals, and beyond a step of about 2/(kappa |V|)
/// |phi| passes 1, which is reported. What the members mean is listed in plant/solver.hpp.
template <class ModelType>
class ExplicitEuler {
 public:
  using Model = ModelType;
  using Scalar = typename Model::Scalar;
  template <class Law>
  static constexpr bool solves = Law::vibration == friction::Vibration::along && !Law::sticks &&
                                 !Law::remembers && !Law::has_corners;

  void configure(const Model& model, Scalar step,
                 std::uint32_t step_limit = max_steps_per_advance) {
    model_ = model;
    step_ = step;
    step_limit_ = step_limit;
    cost_ = Cost();
  }

  template <class Account, class Observer>
  Outcome<Scalar> advance(const IntervalOf<Model>& interval, State<Scalar>& state, Account& account,
                          Observer& observer) {
    const std::uint32_t count = fixed_step_count(interval.duration, step_, step_limit_);
    if (count > step_limit_) {
      return {Error::too_many_steps, Scalar(0)};
    }
    const Scalar length = interval.duration / static_cast<Scalar>(count > 0 ? count : 1);
    Samples drive(interval.drive_amplitude, interval.phase_begin, length);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Scalar begin = length * static_cast<Scalar>(i);
      const Scalar sliding = interval.sliding_velocity + interval.sliding_acceleration * begin;
      const EulerStep<Model> taken(model_, state, drive.value(), sliding, begin, length);
      account.add(taken);
      observer(taken);
      drive.next();
      ++cost_.steps;
      state = taken.at(length);
      const Error error = check_state(model_.law, state);
      if (error != Error::none) {
        return {error, begin + length};
      }
    }
    return {Error::none, interval.duration};
  }

  const Cost& cost() const { return cost_; }

 private:
  using Samples = typename Model::Drive::template Samples<Scalar>;

  Model model_;
  Scalar step_ = Scalar(0);
  std::uint32_t step_limit_ = max_steps_per_advance;
  Cost cost_;
};

}  // namespace sonoglide::plant
