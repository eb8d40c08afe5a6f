/// Classical Runge–Kutta method of fourth order whose steps end at the reversals of the sliding
/// velocity.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "firmware/numeric/float_format.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/outcome.hpp"
#include "firmware/plant/rk4/rk4_formula.hpp"
#include "firmware/plant/rk4/rk4_step.hpp"
#include "firmware/plant/state.hpp"
#include "firmware/plant/velocity_path.hpp"

namespace sonoglide::plant {

/// Fixed steps, each cut where the sliding velocity reverses, so that the fourth order is kept
/// (tableau: rk4_formula.hpp; location of events: Hairer 1993, II.6, ../README.md).
///
///     V  \___
///            \__
///     0 ........\................
///                \__
///        |---h---|-| |---h---|
///                   the step ends at V = 0, and the rest of the grid's step follows
///
/// sgn V is frozen inside a step, which makes it smooth. Where the quartic through the ends of the
/// step reverses, a pair of reversals included, the step is taken again, shorter, until it ends at
/// V = 0: the reversal has the error of the method, not of an interpolation.
///
/// The method is explicit, so a stiff contact limits its step. It reports Error::step_too_long for
/// beta kappa step^2 > 1 (the ringing of a stuck contact), and for kappa |du| > 1/2 in a step in
/// which the friction still grows.
template <class ModelType>
class Rk4Event {
 public:
  using Model = ModelType;
  using Scalar = typename Model::Scalar;
  template <class Law>
  static constexpr bool solves = !Law::sticks && Law::rate_independent && !Law::has_corners;
  static_assert(
      solves<typename Model::FrictionLaw>,
      "with sgn V frozen d phi / d tau is to be in proportion to V, and no stick is a motion");

  /// step: the longest allowed, in tau; > 0. An interval is cut into equal steps.
  /// step_limit: the most steps of one advance, the parts of those that are cut included.
  void configure(const Model& model, Scalar step,
                 std::uint32_t step_limit = max_steps_per_advance) {
    model_ = model;
    step_ = step;
    step_limit_ = step_limit;
    cost_ = Cost();
  }

  /// Advances the state over the interval, adding every step to the account and showing it to the
  /// observer.
  template <class Account, class Observer>
  Outcome<Scalar> advance(const IntervalOf<Model>& interval, State<Scalar>& state, Account& account,
                          Observer& observer) {
    const std::uint32_t count = fixed_step_count(interval.duration, step_, step_limit_);
    if (count > step_limit_) {
      return {Error::too_many_steps, Scalar(0)};
    }
    if (count == 0) {
      return {Error::none, interval.duration};
    }
    const Scalar length = interval.duration / static_cast<Scalar>(count);
    if (!oscillator_is_stable(model_, length) ||
        model_.contact_force(law_stiffness()) * length * length > Scalar(1)) {
      return {Error::step_too_long, Scalar(0)};
    }
    Samples drive(interval.drive_amplitude, interval.phase_begin, numeric::half(length));
    state.friction = model_.law.friction(Scalar(0), state.friction);
    Walk walk = {Scalar(0), 0, shortest_part(interval, length)};
    for (std::uint32_t i = 0; i < count; ++i) {
      const Scalar end = i + 1 < count ? length * static_cast<Scalar>(i + 1) : interval.duration;
      const Error error =
          walk_to(end, interval, following_values(drive), walk, state, account, observer);
      if (error != Error::none) {
        return {error, walk.offset};
      }
    }
    return {Error::none, interval.duration};
  }

  const Cost& cost() const { return cost_; }

 private:
  using Law = typename Model::FrictionLaw;
  using Contact = FrozenContact<Scalar>;
  using Formula = Rk4Formula<Model, Contact>;
  using Samples = typename Model::Drive::template Samples<Scalar>;
  using Stages = Rk4Stages<Scalar>;
  using Path = VelocityPath<Scalar>;

  /// How far an advance has come.
  struct Walk {
    Scalar offset;
    std::uint32_t steps;
    Scalar shortest;  ///< a reversal within this time is over at once: no displacement to speak of
  };

  /// A step that has been tried.
  struct Trial {
    Stages stages;
    Scalar direction;
    Scalar length;
    bool ends_at_reversal;
  };

  // ---- The grid of fixed steps ----

  /// d phi / du of the unloaded contact: kappa under Dahl friction.
  Scalar law_stiffness() const { return model_.law.rate(Scalar(1), Scalar(0)); }

  /// Shortest part of a step: the displacement, quadratic in the part, is below rounding; time and
  /// phase are well above it.
  static Scalar shortest_part(const IntervalOf<Model>& interval, Scalar length) {
    constexpr int digits = std::numeric_limits<Scalar>::digits;
    constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
    return numeric::max(numeric::power_of_two<Scalar>(-digits / 2) * length,
                        Scalar(8) * epsilon * (interval.phase_begin + interval.duration));
  }

  static Rk4Drive<Scalar> following_values(Samples& drive) {
    const Scalar begin = drive.value();
    drive.next();
    const Scalar middle = drive.value();
    drive.next();
    return {begin, middle, drive.value()};
  }
  static Rk4Drive<Scalar> values_over(const IntervalOf<Model>& interval, Scalar begin_value,
                                      Scalar begin, Scalar length) {
    using Phasor = typename Model::Drive::template Phasor<Scalar>;
    const auto value = [&](Scalar offset) {
      return Phasor(interval.drive_amplitude, interval.phase_begin + offset).value();
    };
    return {begin_value, value(begin + numeric::half(length)), value(begin + length)};
  }

  /// From one point of the grid of fixed steps to the next, reversals between them included.
  template <class Account, class Observer>
  Error walk_to(Scalar end, const IntervalOf<Model>& interval, Rk4Drive<Scalar> drive, Walk& walk,
                State<Scalar>& state, Account& account, Observer& observer) {
    for (;;) {
      if (walk.steps == step_limit_) {
        return Error::too_many_steps;
      }
      Trial trial = try_step(interval, drive, walk.offset, end - walk.offset, state,
                             direction_of(interval, walk.offset, state));
      if constexpr (Law::reverses) {
        end_before_reversal(interval, drive, walk, state, trial);
      }
      if (!is_resolved(trial)) {
        return Error::step_too_long;
      }
      const Error error = accept(trial, walk, state, account, observer);
      if (error != Error::none) {
        return error;
      }
      const Scalar rest = end - (walk.offset + trial.length);
      if (!(trial.length < end - walk.offset) || !(rest > Scalar(0))) {
        walk.offset = end;
        return Error::none;
      }
      walk.offset += trial.length;
      drive = values_over(interval, trial.stages.end.drive, walk.offset, rest);
    }
  }

  Trial try_step(const IntervalOf<Model>& interval, const Rk4Drive<Scalar>& drive, Scalar offset,
                 Scalar length, const State<Scalar>& state, Scalar direction) const {
    const Formula formula(model_, interval, Contact{direction});
    return {formula.stages(formula.stage(drive.begin, offset, state), drive, offset, length),
            direction, length, false};
  }

  Scalar direction_of(const IntervalOf<Model>& interval, Scalar offset,
                      const State<Scalar>& state) const {
    const Scalar sliding =
        interval.sliding_velocity + Model::Sliding::change(interval.sliding_acceleration, offset);
    return numeric::sign(model_.contact_velocity(sliding, state.velocity));
  }

  // ---- Reversals ----

  /// Takes a step again that slides the other way from its beginning, or that reverses.
  void end_before_reversal(const IntervalOf<Model>& interval, const Rk4Drive<Scalar>& drive,
                           const Walk& walk, const State<Scalar>& state, Trial& trial) const {
    Course course = course_of(interval, trial, walk.shortest);
    if (course.direction != trial.direction) {
      trial = try_step(interval, drive, walk.offset, trial.length, state, course.direction);
      course = course_of(interval, trial, walk.shortest);
    }
    if (course.reverses) {
      trial = part_before_reversal(interval, drive.begin, walk, state, trial, course.reversal);
    }
  }

  /// Which way a step slides, and when it turns.
  struct Course {
    Scalar direction;
    bool reverses;
    Scalar reversal;  ///< since the beginning of the step
  };

  Course course_of(const IntervalOf<Model>& interval, const Trial& trial, Scalar earliest) const {
    const Path path = sliding_path(interval, trial);
    Course course = {path.first_direction(), false, trial.length};
    if (path.may_reverse()) {
      const Reversals<Scalar> reversals = path.reversals();
      for (std::size_t i = 0; i < reversals.count && !course.reverses; ++i) {
        course.reversal = reversals.at[i] * trial.length;
        course.reverses = course.reversal > earliest;
        course.direction = course.reverses ? course.direction : -course.direction;
      }
    }
    return course;
  }

  Path sliding_path(const IntervalOf<Model>& interval, const Trial& trial) const {
    const Rk4Stage<Scalar>& from = trial.stages.inside[0];
    const Rk4Stage<Scalar>& to = trial.stages.end;
    const Scalar change = to.state.displacement - from.state.displacement;
    return Path({from.state.velocity, from.slope.velocity}, {to.state.velocity, to.slope.velocity},
                change / trial.length, trial.length)
        .sliding(model_, from.sliding_velocity, interval.sliding_acceleration);
  }

  /// Shorter and shorter steps by Newton's method for V = 0, kept between a length before the
  /// reversal and one beyond it. Where V turns back before it reaches zero the step ends there.
  Trial part_before_reversal(const IntervalOf<Model>& interval, Scalar drive, const Walk& walk,
                             const State<Scalar>& state, const Trial& whole, Scalar guess) const {
    constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
    const Scalar direction = whole.direction;
    Scalar before = numeric::half(walk.shortest);
    Scalar beyond = whole.length;
    Trial part = whole;
    Scalar length = guess;
    for (int i = 0; i < 2 * std::numeric_limits<Scalar>::digits; ++i) {
      part = try_step(interval, values_over(interval, drive, walk.offset, length), walk.offset,
                      length, state, direction);
      const Rk4Stage<Scalar>& end = part.stages.end;
      const Scalar velocity =
          direction * model_.contact_velocity(end.sliding_velocity, end.state.velocity);
      const Scalar slope =
          direction * model_.contact_velocity(interval.sliding_acceleration, end.slope.velocity);
      const Scalar rounding =
          epsilon * (numeric::abs(end.sliding_velocity) + numeric::abs(end.state.velocity));
      part.ends_at_reversal = velocity <= rounding;
      if (numeric::abs(velocity) <= rounding || (velocity > Scalar(0) && slope >= Scalar(0))) {
        return part;
      }
      (velocity > Scalar(0) ? before : beyond) = length;
      Scalar next = length - velocity / slope;
      if (!(before < next && next < beyond)) {
        next = numeric::half(before + beyond);
      }
      if (numeric::abs(next - length) <= epsilon * beyond) {
        part.ends_at_reversal = true;
        return part;
      }
      length = next;
    }
    return part;
  }

  // ---- The end of a step ----

  bool is_resolved(const Trial& trial) const {
    const Rk4Stage<Scalar>& from = trial.stages.inside[0];
    const Rk4Stage<Scalar>& to = trial.stages.end;
    const Scalar pull = numeric::half(from.sliding_velocity + to.sliding_velocity) * trial.length;
    const Scalar travel =
        model_.contact_velocity(pull, to.state.displacement - from.state.displacement);
    return !(law_stiffness() * numeric::abs(travel) > numeric::half(Scalar(1))) ||
           is_saturated(trial.direction, from.state.friction);
  }

  /// 1 - |phi| is nothing but rounding.
  static bool is_saturated(Scalar direction, Scalar friction) {
    return Scalar(1) - direction * friction <= Scalar(16) * std::numeric_limits<Scalar>::epsilon();
  }

  template <class Account, class Observer>
  Error accept(const Trial& trial, Walk& walk, State<Scalar>& state, Account& account,
               Observer& observer) {
    const Stages& stages = trial.stages;
    const Rk4Step<Model> taken(model_, stages.inside, stages.end, walk.offset, trial.length);
    state = stages.end.state;
    if constexpr (Law::reverses) {
      if (trial.ends_at_reversal) {
        state.velocity = model_.resting_velocity(stages.end.sliding_velocity);
        ++cost_.events;
      }
      if (is_saturated(trial.direction, state.friction)) {
        state.friction = trial.direction;
      }
    }
    account.add(taken);
    observer(taken);
    ++cost_.steps;
    ++walk.steps;
    return check_state(state);
  }

  Model model_;
  Scalar step_ = Scalar(0);
  std::uint32_t step_limit_ = max_steps_per_advance;
  Cost cost_;
};

}  // namespace sonoglide::plant
