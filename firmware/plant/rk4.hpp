/// Classical Runge–Kutta method of fourth order with a fixed step, as the paper uses it.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/outcome.hpp"
#include "firmware/plant/rk4_step.hpp"
#include "firmware/plant/state.hpp"

namespace sonoglide::plant {

/// Fixed steps that do not look for reversals.
///
/// A reversal inside a step costs the fourth order: the error of the mean friction falls as the
/// square of the step under Dahl, in proportion to the step under Coulomb. Stable in a stiff
/// contact only for step <= 2.785 / (kappa |V|); beyond it |phi| passes 1, which is reported.
template <class ModelType>
class Rk4 {
 public:
  using Model = ModelType;
  using Scalar = typename Model::Scalar;

  /// step: the longest allowed, in tau; > 0. An interval is cut into equal steps.
  void configure(const Model& model, Scalar step) {
    model_ = model;
    step_ = step;
    cost_ = Cost();
  }

  /// Advances the state over the interval, adding every step to the account and showing it to the
  /// observer.
  template <class Account, class Observer>
  Outcome<Scalar> advance(const Interval<Scalar>& interval, State<Scalar>& state, Account& account,
                          Observer& observer) {
    const std::uint32_t count = step_count(interval.duration);
    if (count > max_steps_per_advance) {
      return {Error::too_many_steps, Scalar(0)};
    }
    const Scalar length = interval.duration / static_cast<Scalar>(count);
    Samples drive(interval.drive_amplitude, interval.phase_begin, length / Scalar(2));
    Stage begin = stage(interval, drive, Scalar(0), state);
    for (std::uint32_t i = 0; i < count; ++i) {
      begin =
          step(interval, drive, begin, length * static_cast<Scalar>(i), length, account, observer);
      state = begin.state;
      const Error error = check(state);
      if (error != Error::none) {
        return {error, length * static_cast<Scalar>(i + 1)};
      }
    }
    return {Error::none, interval.duration};
  }

  const Cost& cost() const { return cost_; }

 private:
  using Samples = typename Model::Drive::template Samples<Scalar>;
  using Stage = Rk4Stage<Scalar>;

  /// The smallest number of steps that are not too long; a step that fits a whole number of times
  /// but for rounding counts as fitting.
  std::uint32_t step_count(Scalar duration) const {
    const double steps = numeric::to_real(duration) / numeric::to_real(step_) * (1.0 - 1e-5);
    if (!(steps < static_cast<double>(max_steps_per_advance))) {
      return max_steps_per_advance + 1;
    }
    const auto whole = static_cast<std::uint32_t>(steps);
    return steps > static_cast<double>(whole) ? whole + 1 : whole;
  }

  Stage stage(const Interval<Scalar>& interval, const Samples& drive, Scalar offset,
              State<Scalar> state) const {
    const Scalar sliding = interval.sliding_velocity + interval.sliding_acceleration * offset;
    const Scalar velocity = model_.contact_velocity(sliding, state.velocity);
    state.friction = model_.law.friction(velocity, state.friction);
    return {drive.value(), sliding, state,
            State<Scalar>{state.velocity, model_.acceleration(drive.value(), state),
                          model_.law.rate(velocity, state.friction)}};
  }

  /// The stage at the end of a step from the stage at its beginning.
  template <class Account, class Observer>
  Stage step(const Interval<Scalar>& interval, Samples& drive, const Stage& begin, Scalar offset,
             Scalar length, Account& account, Observer& observer) {
    const State<Scalar>& from = begin.state;
    const Scalar half = length / Scalar(2);
    drive.next();
    const Stage second = stage(interval, drive, offset + half, moved(from, begin.slope, half));
    const Stage third = stage(interval, drive, offset + half, moved(from, second.slope, half));
    drive.next();
    const Stage fourth = stage(interval, drive, offset + length, moved(from, third.slope, length));
    const std::array<Stage, 4> k = {begin, second, third, fourth};
    const State<Scalar> slope = {mean(k, &State<Scalar>::displacement),
                                 mean(k, &State<Scalar>::velocity),
                                 mean(k, &State<Scalar>::friction)};
    const Stage end = stage(interval, drive, offset + length, moved(from, slope, length));
    const Rk4Step<Model> taken(model_, k, end, offset, length);
    account.add(taken);
    observer(taken);
    ++cost_.steps;
    return end;
  }

  static State<Scalar> moved(const State<Scalar>& from, const State<Scalar>& slope, Scalar time) {
    return {from.displacement + time * slope.displacement, from.velocity + time * slope.velocity,
            from.friction + time * slope.friction};
  }

  /// The method's mean of one component of the slopes.
  static Scalar mean(const std::array<Stage, 4>& k, Scalar State<Scalar>::*component) {
    return (k[0].slope.*component + Scalar(2) * (k[1].slope.*component + k[2].slope.*component) +
            k[3].slope.*component) /
           Scalar(6);
  }

  static Error check(const State<Scalar>& state) {
    if (!is_finite(state)) {
      return Error::not_finite;
    }
    const Scalar bound = Scalar(1) + Scalar(64) * std::numeric_limits<Scalar>::epsilon();
    return numeric::abs(state.friction) <= bound ? Error::none : Error::friction_bound_broken;
  }

  Model model_;
  Scalar step_ = Scalar(0);
  Cost cost_;
};

}  // namespace sonoglide::plant
