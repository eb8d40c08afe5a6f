/// Strang splitting that measures its own error, and halves its steps until they are short enough.
#pragma once

#include <cstdint>
#include <limits>

#include "firmware/numeric/float_format.hpp"
#include "firmware/numeric/quick_root.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/turn.hpp"
#include "firmware/plant/outcome.hpp"
#include "firmware/plant/state.hpp"
#include "firmware/plant/state_check.hpp"
#include "firmware/plant/strang/equal_step_strang.hpp"
#include "firmware/plant/strang/measured_strang_step.hpp"
#include "firmware/plant/strang/oscillator_flow.hpp"
#include "firmware/plant/strang/strang_step.hpp"

namespace sonoglide::plant {

/// The steps of EqualStepStrang, taken only where their own defects are small.
///
/// A step is good where its velocity defect is below tolerance times the highest velocity of the
/// interval so far, and its energy defect below tolerance times
///   (length / 2 pi) (kinetic energy at that velocity) + (energy that passed in the step),
/// so that the residual of the balance over n carrier periods is below (n + 3) tolerance of the
/// largest energy that was stored or passed. A step that is not good is taken again in halves, and
/// so is the rest of the interval: in a steady motion all steps are alike, and the splitting stays
/// symmetric. The next interval tries steps twice as long where there is room.
///
/// Without a drive the energy that passed is that which the sliding puts into the contact, or the
/// contact takes: where friction alone sets a mass in motion that was at rest, the kicks of the
/// first step are all of its kinetic energy, however short it is.
///
/// An interval that needs more steps than the limit is declined with Error::too_many_steps. Causes
/// are a stuck contact that rings, a stiff contact that reverses (first order there), an oscillator
/// far faster than the drive, and a tolerance below rounding.
template <class ModelType>
class Strang {
 public:
  using Model = ModelType;
  using Scalar = typename Model::Scalar;
  template <class Law>
  static constexpr bool solves = EqualStepStrang<Model>::template solves<Law>;

  /// tolerance: of velocity and energy, as above; > 0. Not a bound of the friction ratio: of random
  /// contacts over three periods 99 in 100 erred by less than 3e-5 at 1e-4 and by less than 6e-6 at
  /// 1.6e-7, the worst of 25,000 by 5.4e-4 at 1e-4.
  /// step_limit: the most steps of one advance, those taken again included.
  /// longest_step: in tau; > 0. Drive and damper work exactly enough up to about 2.5
  /// tolerance^(1/6), which is never exceeded.
  void configure(const Model& model, Scalar tolerance,
                 std::uint32_t step_limit = max_steps_per_advance,
                 Scalar longest_step = numeric::from_real<Scalar>(0.79)) {
    model_ = model;
    tolerance_ = tolerance;
    longest_step_ = numeric::min(
        longest_step, numeric::from_real<Scalar>(2.5) * numeric::quick_root<6>(tolerance));
    step_ = longest_step_;
    worst_ = Scalar(1);
    step_limit_ = step_limit;
    flow_ = Flow();
    cost_ = Cost();
  }

  /// Advances the state over the interval, adding every step to the account and showing it to the
  /// observer.
  template <class Account, class Observer>
  Outcome<Scalar> advance(const Interval<Scalar>& interval, State<Scalar>& state, Account& account,
                          Observer& observer) {
    if (worst_ <= room_to_double) {
      step_ = numeric::min(longest_step_, numeric::twice(step_));
    }
    worst_ = Scalar(0);
    highest_velocity_ = numeric::max(slowest, numeric::abs(state.velocity));
    state.friction = model_.law.friction(Scalar(0), state.friction);
    std::uint32_t count = fixed_step_count(interval.duration, step_, step_limit_);
    typename Flow::Follower drive(interval);
    std::uint32_t tried = 0;
    for (std::uint32_t done = 0; done < count; ++tried) {
      if (count - done > step_limit_ - tried) {
        return {Error::too_many_steps, flow_.length() * static_cast<Scalar>(done)};
      }
      set_length(interval.duration / static_cast<Scalar>(count));
      if (!step(interval, drive, flow_.length() * static_cast<Scalar>(done), state, account,
                observer)) {
        done *= 2;
        count *= 2;
        step_ = numeric::half(flow_.length());
        continue;
      }
      ++done;
      const Error error = check_state(state);
      if (error != Error::none) {
        return {error, flow_.length() * static_cast<Scalar>(done)};
      }
    }
    return {Error::none, interval.duration};
  }

  const Cost& cost() const { return cost_; }

 private:
  using Flow = OscillatorFlow<Model>;

  /// Doubling a step multiplies its defects by at most the inverse of this. The defect of the path
  /// is of fifth order.
  static constexpr Scalar room_to_double = numeric::from_real<Scalar>(1.0 / 32.0);
  /// The square of a velocity below this has lost its digits.
  static constexpr Scalar slowest = numeric::power_of_two<Scalar>(
      (std::numeric_limits<Scalar>::min_exponent + std::numeric_limits<Scalar>::digits) / 2);

  void set_length(Scalar length) {
    if (flow_.length() != length) {
      flow_ = Flow(model_, length);
    }
  }

  /// Returns false, with the state unchanged, if the step is not good.
  template <class Account, class Observer>
  bool step(const Interval<Scalar>& interval, typename Flow::Follower& drive, Scalar offset,
            State<Scalar>& state, Account& account, Observer& observer) {
    ++cost_.steps;
    typename Flow::Follower moved = drive;
    const StrangStep<Model> taken(model_, flow_, interval, moved, offset, state);
    const MeasuredStrangStep<Model> measured(model_, taken);
    const State<Scalar> end = taken.end();
    const Scalar velocity = numeric::max(highest_velocity_, numeric::abs(end.velocity));
    const Scalar defect = relative_defect(measured, velocity);
    // Not >: a defect that is not a number is not good either.
    if (!(defect <= Scalar(1))) {
      worst_ = Scalar(0);
      return false;
    }
    worst_ = numeric::max(worst_, defect);
    highest_velocity_ = velocity;
    drive = moved;
    state = end;
    account.add(measured);
    observer(measured);
    cost_.events += taken.reversals();
    return true;
  }

  /// Sum of both defects, each over the larger of its allowance and its rounding error; not a
  /// number if one of them is not.
  Scalar relative_defect(const MeasuredStrangStep<Model>& step, Scalar velocity) const {
    constexpr Scalar rounding = Scalar(4) * std::numeric_limits<Scalar>::epsilon();
    constexpr Scalar share = numeric::from_real<Scalar>(0.5 / numeric::two_pi);
    const Scalar kick = step.length() * model_.contact_force(Scalar(1));
    const bool driven = step.motion_integrals().drive_work != Scalar(0);
    const Scalar passed = driven ? step.passed_energy() : step.dragged_energy();
    const Scalar energy = share * step.length() * velocity * velocity + passed;
    return step.velocity_defect() / numeric::max(tolerance_ * velocity, rounding * kick) +
           step.energy_defect() / numeric::max(tolerance_ * energy, rounding * step.energy_terms());
  }

  Model model_;
  Scalar tolerance_ = Scalar(0);
  Scalar longest_step_ = Scalar(0);
  Scalar step_ = Scalar(0);  ///< at most, of the steps to come
  std::uint32_t step_limit_ = max_steps_per_advance;
  Scalar highest_velocity_ = Scalar(0);  ///< of this interval
  Scalar worst_ = Scalar(0);             ///< largest relative defect of this interval
  Flow flow_;
  Cost cost_;
};

}  // namespace sonoglide::plant
