/// A solver that leaves what is far faster than its intervals to others: the closed form takes the
/// linear stretches of a stiff motion, a solver of high order those that turn.
#pragma once

#include <cstdint>
#include <limits>

#include "firmware/friction/vibration.hpp"
#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/turn.hpp"
#include "firmware/plant/outcome.hpp"
#include "firmware/plant/state.hpp"
#include "firmware/plant/stiff/free_mode.hpp"
#include "firmware/plant/stiff/linear_motion.hpp"
#include "firmware/plant/stiff/linear_step.hpp"

namespace sonoglide::plant {

/// `Solver`, but for intervals in which the natural mode, or that of the stuck contact, is far faster
/// than the interval is long.
///
///     interval   |--- turns ---|------- linear -------|
///     taken by     Turning       one step, closed form      32 turns of the mode and more
///                |--------------- Solver -------------|     fewer
///
/// Such an interval is one step in closed form if nothing in it bends the motion: the amplitude of the
/// drive holds, and there is no friction, or the friction cannot change in it by more than a part of the tolerance, because the
/// contact slides the same way all the time and is at its limit, or hardly moves. What bounds the
/// velocity bounds the path of the contact. Where a beginning stands in the way, a vibration that
/// dies away or a contact that is not yet at its limit, `Turning` takes it, and then the closed form
/// takes the rest. `Turning` also takes an interval that is never linear. Each turn costs it the
/// fewest steps if its order is high. All other intervals are those of `Solver`, bit for bit.
///
/// The phase of a mode that turns n times is known to 2 pi n roundings. Where that is more than
/// largest_phase_error the interval is left to `Turning`.
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
    model_ = model;
    mode_ = FreeMode<Scalar>(model.stiffness, model.damping_force(Scalar(1)));
    rate_ = numeric::max(numeric::sqrt(numeric::max(Scalar(0), model.stiffness)),
                         model.damping_force(Scalar(1)));
    held_ = numeric::max(numeric::min(tolerance, numeric::from_real<Scalar>(1e-5)) / Scalar(8),
                         Scalar(4) * std::numeric_limits<Scalar>::epsilon());
    turning_rate_ =
        numeric::max(rate_, numeric::sqrt(numeric::max(Scalar(0), model.stiffness + contact())));
    step_limit_ = step_limit;
    steps_ = 0;
  }

  /// Advances the state over the interval, adding every step to the account and showing it to the
  /// observer.
  template <class Account, class Observer>
  Outcome<Scalar> advance(const IntervalOf<Model>& interval,
                          StateOf<typename Model::FrictionLaw>& state, Account& account,
                          Observer& observer) {
    // Here too, so that an order is compiled for one kind of observer.
    ShiftedObserver<Observer, Scalar> shifted = {observer, Scalar(0)};
    if (turning_rate_ * interval.duration < least_angle) {
      return solver_.advance(interval, state, account, shifted);
    }
    if constexpr (may_be_linear) {
      if (rate_ * interval.duration >= least_angle &&
          mode_.phase_error(interval.duration) <= largest_phase_error) {
        return advance_stiff(interval, state, account, shifted);
      }
    }
    return turning_.advance(interval, state, account, shifted);
  }

  Cost cost() const {
    const Cost solved = solver_.cost();
    const Cost turned = turning_.cost();
    return {solved.steps + turned.steps + steps_, solved.events + turned.events};
  }

 private:
  using Law = typename Model::FrictionLaw;
  using PlantState = StateOf<Law>;
  using Motion = LinearMotion<Scalar>;
  static constexpr bool may_be_linear =
      Law::rate_independent && Law::vibration == friction::Vibration::along;

  /// 32 turns of the natural mode.
  static constexpr Scalar least_angle = numeric::from_real<Scalar>(32.0 * numeric::two_pi);
  /// Of the first part that `Turning` takes where an interval is not yet linear.
  static constexpr Scalar first_part = Scalar(64);
  static constexpr Scalar largest_phase_error =
      numeric::from_real<Scalar>(std::numeric_limits<Scalar>::digits > 24 ? 2e-6 : 1e-2);
  /// Displacements from a static one that is larger by the inverse of this have lost their digits.
  static constexpr Scalar least_creep =
      numeric::from_real<Scalar>(std::numeric_limits<Scalar>::digits > 24 ? 1e-4 : 2e-2);

  /// Square of the mode of a stuck contact that a contact adds to the stiffness.
  Scalar contact() const {
    if constexpr (Law::rate_independent && !Law::remembers) {
      return model_.contact_force(model_.law.rate(Scalar(1), Scalar(0)));
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
    Scalar length = first_part / rate_;
    while (observer.shift < interval.duration) {
      if (cost().steps - before >= step_limit_) {
        return {Error::too_many_steps, observer.shift};
      }
      const Scalar left = interval.duration - observer.shift;
      const IntervalOf<Model> rest = part(interval, observer.shift, left);
      const Scalar solved = solve_longest(rest, state, account, observer);
      if (solved > Scalar(0)) {
        observer.shift = solved < left ? observer.shift + solved : interval.duration;
        length = first_part / rate_;
        continue;
      }
      const bool last = !(length < left) || rate_ * (left - length) < least_angle;
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

  /// Takes as much of the beginning of an interval in one step as it can; 0 if that is nothing.
  template <class Account, class Observer>
  Scalar solve_longest(const IntervalOf<Model>& interval, PlantState& state, Account& account,
                       Observer& observer) {
    for (Scalar length = interval.duration; rate_ * length >= least_angle;
         length *= numeric::from_real<Scalar>(0.25)) {
      if (solve(part(interval, Scalar(0), length), state, account, observer)) {
        return length;
      }
    }
    return Scalar(0);
  }

  /// Takes the interval in one step. Returns false, with the state unchanged, if it cannot.
  template <class Account, class Observer>
  bool solve(const IntervalOf<Model>& interval, PlantState& state, Account& account,
             Observer& observer) {
    const Scalar time = interval.duration;
    const Scalar damping = model_.damping_force(Scalar(1));
    if (!(model_.stiffness * time > least_creep * damping)) {
      return false;
    }
    const Scalar direction =
        numeric::sign(model_.contact_velocity(interval.sliding_velocity, state.velocity));
    const Scalar held =
        typename Law::Arc(model_.law, direction, contact_memory(state)).friction_after(Scalar(0));
    const typename Model::Drive::template Phasor<Scalar> drive(interval.drive_amplitude,
                                                               interval.phase_begin);
    if (!is_linear_force(drive)) {
      return false;
    }
    const Motion motion(mode_, model_.stiffness, damping, force_of(drive),
                        model_.contact_force(held), {state.displacement, state.velocity});
    if (!holds(interval, state, motion, direction, held)) {
      return false;
    }
    const LinearStep<Model> step(model_, interval, observer.shift, motion, held, state);
    const State<Scalar> end = step.end();
    if (!is_finite(end)) {
      return false;
    }
    const Scalar travel = step.travel();
    const typename Law::Arc arc(model_.law, numeric::sign(travel), contact_memory(state));
    static_cast<State<Scalar>&>(state) = end;
    if constexpr (Law::varies) {
      state.friction = arc.friction_after(numeric::abs(travel));
    }
    if constexpr (Law::remembers) {
      state.memory = arc.memory_after(numeric::abs(travel));
    }
    ++steps_;
    account.add(step);
    observer.observer(step);
    return true;
  }

  /// Whether the friction stays what it is: the contact slides one way and is at its limit, or its
  /// path is too short to matter.
  bool holds(const IntervalOf<Model>& interval, const PlantState& state, const Motion& motion,
             Scalar direction, Scalar held) const {
    if constexpr (!Law::reverses) {
      return true;
    } else {
      const Scalar end = interval.sliding_velocity + sliding_change(interval, interval.duration);
      const Scalar path =
          interval.duration *
          (numeric::max(numeric::abs(interval.sliding_velocity), numeric::abs(end)) +
           motion.largest_slow_velocity() + motion.largest_fast_velocity());
      const auto changes = [&](Scalar side) {
        const typename Law::Arc arc(model_.law, side, contact_memory(state));
        return numeric::abs(arc.friction_after(path) - held);
      };
      if (slides_on(interval, motion, direction)) {
        return changes(direction) <= held_;
      }
      return !Law::sticks && numeric::max(changes(Scalar(1)), changes(Scalar(-1))) <=
                                 held_ * numeric::from_real<Scalar>(1.0 / 64.0);
    }
  }

  /// Whether V certainly keeps its sign. Without what is fast it is at least what it is at the
  /// middle, less the most that it changes from there.
  bool slides_on(const IntervalOf<Model>& interval, const Motion& motion, Scalar direction) const {
    const Scalar half_time = numeric::half(interval.duration);
    const Scalar change = sliding_change(interval, half_time);
    const Scalar sliding = interval.sliding_velocity + change;
    const Scalar at_middle =
        direction * model_.contact_velocity(sliding, motion.slow_velocity(half_time));
    const Scalar most_change = numeric::min(half_time * motion.largest_slow_acceleration(),
                                            numeric::twice(motion.largest_slow_velocity()));
    return at_middle - most_change - numeric::abs(change) > motion.largest_fast_velocity();
  }

  static Scalar sliding_change(const IntervalOf<Model>& interval, Scalar time) {
    return Model::Sliding::change(interval.sliding_acceleration, time);
  }

  Model model_;
  FreeMode<Scalar> mode_;
  Scalar rate_ = Scalar(0);  ///< of the natural mode, or of what damps it
  Scalar held_ = Scalar(0);  ///< change of friction that counts as none
  std::uint32_t step_limit_ = max_steps_per_advance;
  Scalar turning_rate_ = Scalar(0);  ///< the fastest of these and of the stuck contact
  Solver solver_;
  Turning turning_;
  std::uint64_t steps_ = 0;  ///< in closed form
};

}  // namespace sonoglide::plant
