/// Strang splitting that measures its own error, and halves its steps until they are short enough.
#pragma once

#include <cstdint>
#include <limits>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/float_format.hpp"
#include "firmware/numeric/quick_root.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/turn.hpp"
#include "firmware/plant/outcome.hpp"
#include "firmware/plant/state.hpp"
#include "firmware/plant/strang/equal_step_strang.hpp"
#include "firmware/plant/strang/oscillator_flow.hpp"
#include "firmware/plant/strang/strang_step.hpp"

namespace sonoglide::plant {

/// The steps of EqualStepStrang, taken only where their own defects are small.
///
/// A step is good where its velocity defect is below tolerance times the highest velocity lately,
/// within a turn of the carrier or of the mode, or while the damper lets it last, and its energy
/// defect below tolerance times
///   (length / 2 pi) (kinetic energy at that velocity) + (energy that passed in the step),
/// so that the residual of the balance over n carrier periods is below (n + 3) tolerance of the
/// largest energy that was stored or passed. A step that is not good is taken again in halves, and
/// two good ones are followed by one of their length where there is room: what is hard at one
/// instant, as the start or a reversal of a stiff contact, does not cut all that comes after it.
///
/// The highest velocity is at least that which drive and friction give a mass within a radian: a
/// step that begins at rest has none that is worth a comparison, however short it is.
///
/// An interval that needs more steps than the limit is declined with Error::too_many_steps. Causes
/// are a stuck contact that rings, friction as strong as the drive (second order), an oscillator far
/// faster than the drive, and a tolerance below rounding.
template <class ModelType>
class Strang {
 public:
  using Model = ModelType;
  using Scalar = typename Model::Scalar;
  template <class Law>
  static constexpr bool solves = EqualStepStrang<Model>::template solves<Law>;

  /// tolerance: of velocity and energy, as above; > 0. Not a bound of the friction ratio: of random
  /// contacts over three periods 99 in 100 erred by less than 6e-5 at 1e-4 and by less than 9e-6 at
  /// 1.6e-7; of 38,000 four by more than 1e-3 at 1e-4, where the sliding only just turns, or where
  /// friction as printed, which pumps, makes much of any error.
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
    const Scalar mode = numeric::sqrt(numeric::abs(model.stiffness));
    fading_ = numeric::max(
        numeric::from_real<Scalar>(1.0 / numeric::two_pi) * numeric::max(Scalar(1), mode),
        model.damping_force(Scalar(1)));
    step_limit_ = step_limit;
    flow_ = Flow();
    cost_ = Cost();
  }

  /// Advances the state over the interval, adding every step to the account and showing it to the
  /// observer.
  template <class Account, class Observer>
  Outcome<Scalar> advance(const IntervalOf<Model>& interval, State<Scalar>& state, Account& account,
                          Observer& observer) {
    state.friction = model_.law.friction(Scalar(0), state.friction);
    least_velocity_ = numeric::max(slowest, pushed(interval, state));
    highest_velocity_ = numeric::max(least_velocity_, numeric::abs(state.velocity));
    const std::uint64_t fewest = fixed_step_count(interval.duration, longest_step_, step_limit_);
    std::uint64_t count = fewest;
    while (count <= most_steps && step_ * static_cast<Scalar>(count) < almost * interval.duration) {
      count *= 2;
    }
    typename Flow::Follower drive(interval);
    std::uint32_t tried = 0;
    for (std::uint64_t done = 0; done < count; ++tried) {
      if (tried == step_limit_ || fewest > step_limit_ || count > most_steps) {
        return {Error::too_many_steps, flow_.length() * static_cast<Scalar>(done)};
      }
      set_length(interval.duration / static_cast<Scalar>(count));
      const Scalar offset = flow_.length() * static_cast<Scalar>(done);
      const Scalar defect = step(interval, drive, offset, state, account, observer);
      // Not >: a defect that is not a number is not good either.
      if (!(defect <= Scalar(1))) {
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
      if (defect <= room_to_double && done % 2 == 0 && count > fewest) {
        done /= 2;
        count /= 2;
        step_ = numeric::twice(flow_.length());
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
  /// As fixed_step_count() takes it.
  static constexpr Scalar almost = numeric::from_real<Scalar>(1.0 - 1e-5);
  /// Of equal length in one interval. Shorter ones are lost in the rounding of the time.
  static constexpr std::uint64_t most_steps = std::uint64_t{1} << 40U;

  void set_length(Scalar length) {
    if (flow_.length() != length) {
      flow_ = Flow(model_, length);
    }
  }

  /// Velocity that drive and friction give a mass at rest within a radian, at least about. The
  /// sliding drags it along no faster than it is itself.
  Scalar pushed(const IntervalOf<Model>& interval, const State<Scalar>& state) const {
    const Scalar slide = numeric::abs(interval.sliding_velocity);
    const typename Model::FrictionLaw::Arc arc(model_.law, numeric::sign(interval.sliding_velocity),
                                               state.friction);
    const Scalar friction =
        numeric::max(numeric::abs(state.friction), numeric::abs(arc.friction_after(slide)));
    const Scalar dragged = numeric::min(slide, model_.contact_force(friction));
    const Scalar force = numeric::max(dragged, largest_force(interval.drive_amplitude));
    return force / numeric::max(Scalar(1), numeric::max(numeric::abs(model_.stiffness),
                                                        model_.damping_force(Scalar(1))));
  }

  /// The relative defect of a step; the state is unchanged if it is not good.
  template <class Account, class Observer>
  Scalar step(const IntervalOf<Model>& interval, typename Flow::Follower& drive, Scalar offset,
              State<Scalar>& state, Account& account, Observer& observer) {
    ++cost_.steps;
    typename Flow::Follower moved = drive;
    const StrangStep<Model> taken(model_, flow_, interval, moved, offset, state);
    const MeasuredStrangStep<Model> measured(model_, taken);
    const State<Scalar> end = taken.end();
    const Scalar velocity = numeric::max(highest_velocity_, numeric::abs(end.velocity));
    const Scalar defect = relative_defect(measured, velocity);
    if (!(defect <= Scalar(1))) {
      return defect;
    }
    highest_velocity_ =
        numeric::max(least_velocity_, velocity / (Scalar(1) + fading_ * flow_.length()));
    drive = moved;
    state = end;
    account.add(measured);
    observer(measured);
    cost_.events += taken.reversals();
    return defect;
  }

  /// Sum of both defects, each over the larger of its allowance and its rounding error; not a
  /// number if one of them is not.
  Scalar relative_defect(const MeasuredStrangStep<Model>& step, Scalar velocity) const {
    constexpr Scalar rounding = Scalar(4) * std::numeric_limits<Scalar>::epsilon();
    constexpr Scalar share = numeric::from_real<Scalar>(0.5 / numeric::two_pi);
    const Scalar kick = step.length() * model_.contact_force(Scalar(1));
    const Scalar energy = share * step.length() * velocity * velocity + step.passed_energy();
    return step.velocity_defect() / numeric::max(tolerance_ * velocity, rounding * kick) +
           step.energy_defect() / numeric::max(tolerance_ * energy, rounding * step.energy_terms());
  }

  Model model_;
  Scalar tolerance_ = Scalar(0);
  Scalar longest_step_ = Scalar(0);
  Scalar step_ = Scalar(0);  ///< at most, of the steps to come
  std::uint32_t step_limit_ = max_steps_per_advance;
  Scalar fading_ = Scalar(0);            ///< rate at which a velocity is forgotten
  Scalar least_velocity_ = Scalar(0);    ///< that counts, in this interval
  Scalar highest_velocity_ = Scalar(0);  ///< lately
  Flow flow_;
  Cost cost_;
};

}  // namespace sonoglide::plant
