/// A solver that leaves what is far faster than its intervals to others: the closed form takes the
/// linear stretches of a stiff motion, a solver of high order those that turn.
#pragma once

#include <cstdint>

#include "firmware/friction/vibration.hpp"
#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/outcome.hpp"
#include "firmware/plant/state.hpp"
#include "firmware/plant/stiff/linear_part.hpp"

namespace sonoglide::plant {

/// `Solver`, but for intervals in which the natural mode, or that of the stuck contact, is far faster
/// than the interval is long.
///
///     interval   |--- turns ---|------- linear -------|
///     taken by     Turning       one step, closed form      32 turns of the mode and more
///                |--------------- Solver -------------|     fewer
///
/// Such an interval is one step in closed form where LinearPart takes it. Where a beginning stands in
/// the way, a vibration that dies away or a contact that is not yet at its limit, `Turning` takes it,
/// and then the closed form takes the rest. `Turning` also takes an interval that is never linear, or
/// whose phase is lost. Each turn costs it the fewest steps if its order is high. All other intervals
/// are those of `Solver`, bit for bit.
///
/// Strictness: the tolerance of `Solver` over that of `Turning`, where they mean different errors.
template <class Solver, class Turning = Solver, int Strictness = 1>
class StiffLinear {
 public:
  using Model = typename Solver::Model;
  using Scalar = typename Model::Scalar;
  template <class Law>
  static constexpr bool solves = Solver::template solves<Law>;

  /// As of Solver.
  template <class... Settings>
  void configure(const Model& model, Scalar tolerance,
                 std::uint32_t step_limit = max_steps_per_advance, Settings... settings) {
    solver_.configure(model, tolerance, step_limit, settings...);
    turning_.configure(model, tolerance / Scalar(Strictness), step_limit);
    linear_.configure(model, tolerance);
    turning_rate_ = numeric::max(
        linear_.rate(), numeric::sqrt(numeric::max(Scalar(0), model.stiffness + contact(model))));
    step_limit_ = step_limit;
  }

  /// Advances the state over the interval, adding every step to the account and showing it to the
  /// observer.
  template <class Account, class Observer>
  Outcome<Scalar> advance(const IntervalOf<Model>& interval,
                          StateOf<typename Model::FrictionLaw>& state, Account& account,
                          Observer& observer) {
    // Here too, so that an order is compiled for one kind of observer.
    ShiftedObserver<Observer, Scalar> shifted = {observer, Scalar(0)};
    if (turning_rate_ * interval.duration < Linear::least_angle) {
      return solver_.advance(interval, state, account, shifted);
    }
    if constexpr (may_be_linear) {
      if (linear_.may_take(interval.duration)) {
        return advance_stiff(interval, state, account, shifted);
      }
    }
    return turning_.advance(interval, state, account, shifted);
  }

  Cost cost() const {
    const Cost solved = solver_.cost();
    const Cost turned = turning_.cost();
    return {solved.steps + turned.steps + linear_.steps(), solved.events + turned.events};
  }

 private:
  using Law = typename Model::FrictionLaw;
  using PlantState = StateOf<Law>;
  using Linear = LinearPart<Model>;
  static constexpr bool may_be_linear =
      Law::rate_independent && Law::vibration == friction::Vibration::along;

  /// Of the first part that `Turning` takes where an interval is not yet linear.
  static constexpr Scalar first_part = Scalar(64);

  /// Square of the mode of a stuck contact that a contact adds to the stiffness.
  static Scalar contact(const Model& model) {
    if constexpr (Law::rate_independent && !Law::remembers) {
      return model.contact_force(model.law.rate(Scalar(1), Scalar(0)));
    }
    return Scalar(0);
  }

  static IntervalOf<Model> part(IntervalOf<Model> interval, Scalar begin, Scalar duration) {
    interval.phase_begin += begin;
    interval.sliding_velocity += Model::Sliding::change(interval.sliding_acceleration, begin);
    interval.duration = duration;
    return interval;
  }

  /// Out of line: it is rare.
  template <class Account, class Observer>
  [[gnu::noinline]] Outcome<Scalar> advance_stiff(const IntervalOf<Model>& interval,
                                                  PlantState& state, Account& account,
                                                  ShiftedObserver<Observer, Scalar>& observer) {
    const std::uint64_t before = cost().steps;
    Scalar length = first_part / linear_.rate();
    while (observer.shift < interval.duration) {
      if (cost().steps - before >= step_limit_) {
        return {Error::too_many_steps, observer.shift};
      }
      const Scalar left = interval.duration - observer.shift;
      const IntervalOf<Model> rest = part(interval, observer.shift, left);
      const Scalar solved = linear_.advance(rest, state, account, observer);
      if (solved > Scalar(0)) {
        observer.shift = solved < left ? observer.shift + solved : interval.duration;
        length = first_part / linear_.rate();
        continue;
      }
      const bool last = !(length < left) || !linear_.turns(left - length);
      const Outcome<Scalar> outcome =
          turning_.advance(last ? rest : part(rest, Scalar(0), length), state, account, observer);
      if (outcome.error != Error::none) {
        return {outcome.error, observer.shift + outcome.offset};
      }
      observer.shift = last ? interval.duration : observer.shift + length;
      length = numeric::twice(length);
    }
    return {Error::none, interval.duration};
  }

  Solver solver_;
  Turning turning_;
  Linear linear_;
  Scalar turning_rate_ = Scalar(0);  ///< the fastest of the natural mode and of the stuck contact
  std::uint32_t step_limit_ = max_steps_per_advance;
};

}  // namespace sonoglide::plant
