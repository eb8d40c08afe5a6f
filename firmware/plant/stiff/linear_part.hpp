/// The linear part of a stiff motion as one step in closed form.
#pragma once

#include <cstdint>
#include <limits>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/turn.hpp"
#include "firmware/plant/outcome.hpp"
#include "firmware/plant/state.hpp"
#include "firmware/plant/stiff/free_mode.hpp"
#include "firmware/plant/stiff/linear_motion.hpp"
#include "firmware/plant/stiff/linear_step.hpp"

namespace sonoglide::plant {

/// Takes an interval of many turns of the natural mode as one step, if nothing in it bends the motion:
/// the amplitude of the drive holds, and there is no friction, or the friction cannot change in it by
/// more than a part of the tolerance, because the contact slides the same way all the time and is at
/// its limit, or hardly moves. What bounds the velocity bounds the path of the contact.
///
/// The phase of a mode that turns n times is known to 2 pi n roundings. An interval in which that is
/// more than largest_phase_error is not taken.
///
/// Compiled once for a model, whatever the solver that it stands beside.
template <class ModelType>
class LinearPart {
 public:
  using Model = ModelType;
  using Scalar = typename Model::Scalar;
  using PlantState = StateOf<typename Model::FrictionLaw>;

  void configure(const Model& model, Scalar tolerance) {
    model_ = model;
    mode_ = FreeMode<Scalar>(model.stiffness, model.damping_force(Scalar(1)));
    rate_ = numeric::max(numeric::sqrt(numeric::max(Scalar(0), model.stiffness)),
                         model.damping_force(Scalar(1)));
    held_ = numeric::max(numeric::min(tolerance, numeric::from_real<Scalar>(1e-5)) / Scalar(8),
                         Scalar(4) * std::numeric_limits<Scalar>::epsilon());
    steps_ = 0;
  }

  /// Of the natural mode, or of what damps it.
  Scalar rate() const { return rate_; }

  std::uint64_t steps() const { return steps_; }

  /// Whether an interval has enough turns, and a phase that is known.
  bool may_take(Scalar duration) const {
    return turns(duration) && mode_.phase_error(duration) <= largest_phase_error;
  }

  bool turns(Scalar duration) const { return rate_ * duration >= least_angle; }

  /// Takes as much of the beginning of an interval in one step as it can; 0 if that is nothing.
  /// Out of line: it is rare.
  template <class Account, class Observer>
  [[gnu::noinline]] Scalar advance(IntervalOf<Model> interval, PlantState& state, Account& account,
                                   ShiftedObserver<Observer, Scalar>& observer) {
    for (; turns(interval.duration); interval.duration *= numeric::from_real<Scalar>(0.25)) {
      if (solve(interval, state, account, observer)) {
        return interval.duration;
      }
    }
    return Scalar(0);
  }

  /// 32 turns of the natural mode.
  static constexpr Scalar least_angle = numeric::from_real<Scalar>(32.0 * numeric::two_pi);

 private:
  using Law = typename Model::FrictionLaw;
  using Motion = LinearMotion<Scalar>;

  static constexpr Scalar largest_phase_error =
      numeric::from_real<Scalar>(std::numeric_limits<Scalar>::digits > 24 ? 2e-6 : 1e-2);
  /// Displacements from a static one that is larger by the inverse of this have lost their digits.
  static constexpr Scalar least_creep =
      numeric::from_real<Scalar>(std::numeric_limits<Scalar>::digits > 24 ? 1e-4 : 2e-2);

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
  Scalar rate_ = Scalar(0);
  Scalar held_ = Scalar(0);  ///< change of friction that counts as none
  std::uint64_t steps_ = 0;
};

}  // namespace sonoglide::plant
