/// The default solver: Taylor series between the reversals of the sliding velocity.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "firmware/friction/vibration.hpp"
#include "firmware/numeric/first_root.hpp"
#include "firmware/numeric/quick_root.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/outcome.hpp"
#include "firmware/plant/state.hpp"
#include "firmware/plant/taylor/branch_at_rest.hpp"
#include "firmware/plant/taylor/first_reversal.hpp"
#include "firmware/plant/taylor/normal_piece.hpp"
#include "firmware/plant/taylor/step_friction.hpp"
#include "firmware/plant/taylor/step_share.hpp"
#include "firmware/plant/taylor/taylor_series.hpp"
#include "firmware/plant/taylor/taylor_step.hpp"

namespace sonoglide::plant {

/// Taylor method of fixed order whose steps end at the reversals of the sliding velocity.
///
///     V  __                 __
///       /  \      stick    /
///     0 ....\..._______.../.....
///            \_/
///       |---|--|-------|--|     steps; each is one power series of V, y and phi
///
/// Inside a step sgn V is constant and the motion is analytic. The force is expanded up to the
/// power Order, and V, its integral, one power higher. The step is the longest one, up to 3 rad,
/// whose last two terms stay below what the tolerance allows. This holds strictly for the terms of
/// V, and more loosely for those of phi, because the mean of phi follows from the displacement
/// where its series does not give it. The first root of V is found with certainty. The step ends
/// there; V is set to zero, and the contact slides on, turns or sticks. Friction that does not
/// depend on the speed follows from the displacement exactly, so that |phi| <= 1 for any step.
///
/// The quickest order is 8 at tolerances above 1e-5, 12 down to 1e-8, 16 below, and 20 from 1e-11
/// on; float needs no more than 8. A contact that sticks for ever costs as much as its ringing,
/// which grows as sqrt(beta kappa).
/// Source: Jorba 2005 (step size from the last two terms), Moore 1966 and Hairer 1993, I.8
/// (recurrences of the coefficients), see ../README.md.
template <class ModelType, std::size_t Order>
class EventTaylor {
  static_assert(Order >= 4 && Order <= 24, "the tables reach order 24");

 public:
  using Model = ModelType;
  using Scalar = typename Model::Scalar;

  /// Friction laws that it can solve.
  template <class Law>
  static constexpr bool solves = true;

  /// tolerance: of the mean friction over a hundred carrier periods, relative to Fc, and of the
  /// velocity, in units of its scale; > 0. It is not a bound: of random contacts 95 in 100 erred by
  /// less. The worst erred by ten times as much, where the vibration only just reverses the
  /// sliding.
  /// step_limit: the most steps that one advance may take.
  void configure(const Model& model, Scalar tolerance,
                 std::uint32_t step_limit = max_steps_per_advance) {
    model_ = model;
    allowed_ = last_term_per_error * (share(model) * tolerance);
    longest_step_ = usual_step();
    step_limit_ = step_limit;
    cost_ = Cost();
  }

  /// Advances the state over the interval, adding every step to the account and showing it to the
  /// observer.
  template <class Account, class Observer>
  [[gnu::flatten]] Outcome<Scalar> advance(const IntervalOf<Model>& interval,
                                           typename Model::PlantState& state, Account& account,
                                           Observer& observer) {
    snap_to_rest(interval, state);
    Position position = {Scalar(0), Scalar(0)};
    for (std::uint32_t steps = 0; position.offset < interval.duration; ++steps) {
      if (steps == step_limit_) {
        return {Error::too_many_steps, position.offset};
      }
      settle(interval, position, state);
      const Error error = step(interval, position, state, account, observer);
      if (error != Error::none) {
        return {error, position.offset};
      }
    }
    return {Error::none, interval.duration};
  }

  const Cost& cost() const { return cost_; }

 private:
  using Law = typename Model::FrictionLaw;
  using At = InstantOf<Model>;
  using PlantState = typename Model::PlantState;
  static constexpr bool moves = Model::Sliding::moves;
  using Drive = typename Model::Drive::template Phasor<Scalar>;
  using Arc = typename SlidingLaw<Law, Order>::Type;
  using Series = TaylorSeries<Model, Order>;
  using Coefficients = typename Series::Coefficients;
  static constexpr bool is_across = Law::vibration == friction::Vibration::across;
  static constexpr bool is_normal = Law::vibration == friction::Vibration::normal;
  using Sliding =
      std::conditional_t<is_across, AcrossFriction<Series, Arc>,
                         std::conditional_t<Law::rate_independent, SlidingFriction<Model, Series>,
                                            RatedFriction<Series, Arc>>>;

  /// Highest power of V. Friction that follows from the displacement enters by the force alone,
  /// whose terms go into V one power higher. Other friction is as good as its own series.
  static constexpr std::size_t last_power = Law::rate_independent ? Order + 1 : Order;
  static constexpr int degree = static_cast<int>(last_power);

  /// A normal force that vibrates makes the limit of the friction follow the displacement. Across
  /// the sliding the series of the law ends the steps.
  static constexpr Drift drift = is_normal   ? Drift::of_displacement
                                 : is_across ? Drift::hardly_felt
                                             : Drift::of_velocity;

  struct Position {
    Scalar offset;
    Scalar released;  ///< direction in which a stick has just ended, else 0
  };

  // ---- Constants ----

  /// Ratio of the last term that a step uses to the first term that it leaves out, about.
  static constexpr Scalar last_term_per_error = Scalar(4);
  /// Weights of the last terms of phi if friction follows from the displacement: they act by the
  /// force alone.
  static constexpr Scalar least_weight = numeric::from_real<Scalar>(1e-3);
  static constexpr Scalar most_weight = numeric::from_real<Scalar>(0.125);
  /// Weight if a Memory has no other account than its series: the error of a step stays in the next
  /// ones, so the last terms of phi stay below the tolerance themselves.
  static constexpr Scalar memory_weight = last_term_per_error;
  /// A term of phi changes the mean over a period by less than the term over this.
  static constexpr Scalar term_per_mean = Scalar(64);
  /// Rest of phi below its limit that is negligible: as a part of the last terms allowed, and at
  /// most.
  static constexpr Scalar unsettled = numeric::from_real<Scalar>(0.125);
  static constexpr Scalar most_unsettled = numeric::from_real<Scalar>(1e-6);
  static constexpr Scalar longest_step = Scalar(3);
  /// Factor by which a unit is shortened after its series has overflowed.
  static constexpr Scalar overflow_retreat = numeric::from_real<Scalar>(1.0 / 1024.0);

  /// Part of the tolerance for a step.
  static Scalar share(const Model& model) {
    if constexpr (moves) {
      return numeric::min(step_share(model.stiffness, drift),
                          step_share(model.load_stiffness, drift));
    } else {
      return step_share(model.stiffness, drift);
    }
  }

  /// Step that a vibration of unit amplitude allows, with a margin; 3 rad at most.
  Scalar usual_step() const {
    Scalar product = allowed_;
    for (std::size_t n = 2; n <= last_power; ++n) {
      product *= static_cast<Scalar>(n);
    }
    return numeric::min(longest_step,
                        numeric::from_real<Scalar>(0.85) * numeric::quick_root<degree>(product));
  }

  // ---- At the beginning of a step ----

  /// Makes V exactly zero where the previous interval ended at V = 0 and only rounding is left of
  /// it.
  void snap_to_rest(const IntervalOf<Model>& interval, PlantState& state) const {
    if constexpr (Law::reverses) {
      const Scalar sliding = sliding_velocity(interval, {}, state);
      const Scalar velocity = model_.contact_velocity(sliding, state.velocity);
      const Scalar rounding = Scalar(4) * std::numeric_limits<Scalar>::epsilon();
      if (numeric::abs(velocity) <= rounding * numeric::abs(sliding)) {
        state.velocity = model_.resting_velocity(sliding);
      }
    }
  }

  /// While the contact slips, sets friction that is short of its limit by a negligible rest to the
  /// limit.
  void settle(const IntervalOf<Model>& interval, const Position& position,
              PlantState& state) const {
    if constexpr (Law::varies && Law::rate_independent && !Law::remembers) {
      const Scalar velocity =
          model_.contact_velocity(sliding_velocity(interval, position, state), state.velocity);
      const Scalar limit = velocity > Scalar(0) ? Scalar(1) : Scalar(-1);
      const Scalar negligible = numeric::min(unsettled * allowed_, most_unsettled);
      if (velocity != Scalar(0) && Scalar(1) - limit * state.friction <= negligible) {
        state.friction = limit;
      }
    }
  }

  // ---- Which kind of step: sliding, sticking, pressed ----

  template <class Account, class Observer>
  Error step(const IntervalOf<Model>& interval, Position& position, PlantState& state,
             Account& account, Observer& observer) {
    const At instant = instant_at(interval, position, state);
    if constexpr (is_normal) {
      press(interval, instant, position, state, account, observer);
    } else if (const Error error = rub(interval, instant, position, state, account, observer);
               error != Error::none) {
      return error;
    }
    return is_finite(state) ? Error::none : Error::not_finite;
  }

  /// The contact rubs on the vibrating mass: it slides, turns or sticks.
  ///
  /// @return not_finite where a coefficient is beyond the largest number in any unit of time
  template <class Account, class Observer>
  Error rub(const IntervalOf<Model>& interval, const At& instant, Position& position,
            PlantState& state, Account& account, Observer& observer) {
    Branch<Scalar> branch = choose_branch(instant, position.released);
    position.released = Scalar(0);
    if constexpr (Law::sticks) {
      if (branch.sticks) {
        stick(interval, instant, branch, position, state, account, observer);
        return Error::none;
      }
    }
    Scalar unit = sliding_unit(instant, interval.duration - position.offset);
    do {
      switch (slide(interval, instant, branch, unit, position, state, account, observer)) {
        case Slide::done:
          return Error::none;
        case Slide::reversal_too_close:
          branch = {false, -branch.direction, branch.zero_order + 1};
          break;
        case Slide::overflow:
          unit *= overflow_retreat;
          break;
      }
    } while (unit > std::numeric_limits<Scalar>::min());
    return Error::not_finite;
  }

  At instant_at(const IntervalOf<Model>& interval, const Position& position,
                const PlantState& state) const {
    const Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
    const Scalar change = sliding_change(interval, position);
    const Scalar phase = interval.phase_begin + position.offset;
    const Instant<Model> instant = {
        Drive(interval.drive_amplitude, phase),
        interval.sliding_velocity + change,
        interval.sliding_acceleration,
        epsilon * (Scalar(16) + numeric::twice(phase)),
        epsilon * (numeric::abs(interval.sliding_velocity) + numeric::abs(change)),
        state};
    if constexpr (moves) {
      return with_load(interval, position, instant);
    } else {
      return instant;
    }
  }

  /// What the interval says of the sliding holds for the pulled end of the load's spring.
  At with_load(const IntervalOf<Model>& interval, const Position& position,
               Instant<Model> instant) const {
    const Scalar pull_velocity = instant.sliding_velocity;
    const Scalar force = interval.load_force + interval.load_force_rate * position.offset;
    const Scalar velocity = instant.state.sliding_velocity;
    const Scalar extension = instant.state.extension;
    instant.sliding_velocity = velocity;
    instant.sliding_acceleration = model_.free_load_acceleration(force, velocity, extension);
    instant.rest_error = std::numeric_limits<Scalar>::epsilon() * numeric::abs(velocity);
    const Scalar moduli = numeric::abs(force) + model_.load_damping * numeric::abs(velocity) +
                          model_.load_stiffness * numeric::abs(extension);
    return {instant,
            force,
            interval.load_force_rate,
            pull_velocity,
            interval.sliding_acceleration,
            instant.relative_error * moduli};
  }

  /// Of the body: what the interval gives, or its own.
  static Scalar sliding_velocity(const IntervalOf<Model>& interval, const Position& position,
                                 const PlantState& state) {
    if constexpr (moves) {
      return state.sliding_velocity;
    } else {
      return interval.sliding_velocity + sliding_change(interval, position);
    }
  }

  /// Change of the sliding velocity since the interval began.
  static Scalar sliding_change(const IntervalOf<Model>& interval, const Position& position) {
    return Model::Sliding::change(interval.sliding_acceleration, position.offset);
  }

  /// The mass presses on a slider beside it. No friction acts on the mass.
  template <class Account, class Observer>
  void press(const IntervalOf<Model>& interval, const At& instant, Position& position,
             State<Scalar>& state, Account& account, Observer& observer) {
    const Scalar rest_of_time = interval.duration - position.offset;
    Series series = alone(instant, numeric::min(longest_step_, rest_of_time));
    const NormalPiece<Law, Series> piece(model_.law, series, state.friction);
    series.friction = piece.friction();

    const Scalar remaining = rest_of_time / series.unit;
    const Scalar longest = sliding_extent(series, remaining);
    const Scalar end = piece.end(longest);
    cost_.events += end < longest ? 1 : 0;
    // Time moves, however close the next corner.
    const Scalar shortest =
        numeric::twice(std::numeric_limits<Scalar>::epsilon()) * position.offset / series.unit;
    const Scalar extent = numeric::min(numeric::max(end, shortest), remaining);
    const NormalFriction<Law, Series> friction(model_.law, series);
    accept(interval, series, friction, extent, extent == remaining, position, state, account,
           observer);
  }

  /// The motion without friction, in a unit in which no coefficient overflows.
  Series alone(const At& instant, Scalar unit) const {
    Arc nothing(model_.law, Scalar(0), instant.state.friction);
    Series series(model_, instant, unit);
    series.slide(model_, nothing);
    while (!series.is_finite() && unit > std::numeric_limits<Scalar>::min()) {
      unit *= overflow_retreat;
      series = Series(model_, instant, unit);
      series.slide(model_, nothing);
    }
    return series;
  }

  Branch<Scalar> choose_branch(const At& instant, Scalar released) const {
    if constexpr (Law::reverses) {
      const Scalar velocity =
          model_.contact_velocity(instant.sliding_velocity, instant.state.velocity);
      if (velocity == Scalar(0)) {
        return BranchAtRest<Model, Order>(model_, instant).choose(released);
      }
      return {false, velocity > Scalar(0) ? Scalar(1) : Scalar(-1), 0};
    }
    return {false, Scalar(0), 0};
  }

  // ---- A sliding step ----

  /// Result of a try to slide.
  enum class Slide {
    done,
    reversal_too_close,  ///< nothing is done: the next reversal is too close for time to move
    overflow             ///< nothing is done: a coefficient is beyond the largest number
  };

  /// unit: the time in which the series is written.
  template <class Account, class Observer>
  Slide slide(const IntervalOf<Model>& interval, const At& instant, const Branch<Scalar>& branch,
              Scalar unit, Position& position, PlantState& state, Account& account,
              Observer& observer) {
    Arc arc(model_.law, branch.direction, contact_memory(state));
    Series series(model_, instant, unit);
    series.slide(model_, arc);
    if (!series.is_finite()) {
      return Slide::overflow;
    }
    const Scalar rest_of_time = interval.duration - position.offset;
    const Scalar remaining = rest_of_time / series.unit;
    const Scalar longest =
        within_reach(series, within_mean(arc, sliding_extent(series, remaining)));
    const Scalar reversal = up_to_reversal(series, branch, longest);
    const bool stands_still =
        reversal < longest && position.offset + reversal * series.unit == position.offset;
    if (stands_still && can_slide_beyond(branch)) {
      return Slide::reversal_too_close;
    }
    const Scalar extent = up_to_corner(series, arc, branch.direction, reversal);
    const Sliding friction(series, arc, branch.direction, term_per_mean * allowed_);
    accept(interval, series, friction, extent, extent == remaining, position, state, account,
           observer);
    if constexpr (Law::reverses) {
      if (extent < longest && extent == reversal) {
        rest(interval, position, state);
      }
    }
    return Slide::done;
  }

  // ---- How far a step may reach ----

  /// The expected length of the next step.
  Scalar sliding_unit(const At& instant, Scalar rest_of_time) const {
    const auto velocity = model_.contact_velocity(instant.sliding_velocity, instant.state.velocity);
    return model_.law.series_unit(velocity, contact_memory(instant.state),
                                  numeric::min(longest_step_, rest_of_time));
  }

  /// How far a step may slide. The speed that the vibration reaches in the step is known only once
  /// the step is. If it is far less than in a unit, as in a contact that rings, a second pass
  /// follows.
  Scalar sliding_extent(const Series& series, Scalar remaining) const {
    const Scalar fastest = speed(series, Scalar(1));
    const Scalar extent = extent_at(fastest, series, remaining);
    const Scalar within = speed(series, extent);
    return within < numeric::half(fastest) ? extent_at(within, series, remaining) : extent;
  }

  /// The extent, shortened to where the mean friction is accurate. Only friction of which another
  /// part acts on the oscillator needs this.
  Scalar within_mean(const Arc& arc, Scalar extent) const {
    if constexpr (is_across) {
      return numeric::min(
          extent, reach(numeric::abs(arc.friction_along(Order)),
                        numeric::abs(arc.friction_along(Order - 1)), allowed_ / most_weight));
    }
    return extent;
  }

  /// The extent, shortened to where the series of the law is valid.
  Scalar within_reach(const Series& series, Scalar extent) const {
    if constexpr (!Law::rate_independent) {
      Scalar change = Scalar(0);
      for (std::size_t n = series.travel.size() - 1; n > 0; --n) {
        change = extent * (change + numeric::abs(series.travel[n]));
      }
      if constexpr (is_across) {
        change += extent * series.unit * numeric::abs(series.sliding_velocity[1]);
      }
      const Scalar reach = series.unit * model_.law.reach(contact_velocity(series));
      return change > reach ? extent * (reach / change) : extent;
    }
    return extent;
  }

  auto contact_velocity(const Series& series) const {
    if constexpr (is_across) {
      return model_.contact_velocity(series.sliding_velocity[0], series.velocity);
    } else {
      return series.travel[0] / series.unit;
    }
  }

  Scalar extent_at(Scalar speed, const Series& series, Scalar remaining) const {
    return step_extent(last_term(series, 0, speed), last_term(series, 1, speed), speed, series,
                       remaining);
  }

  /// Scale of the error of the velocity: the velocity scale, or a smaller vibration itself on the
  /// way to x, with a lower bound.
  Scalar speed(const Series& series, Scalar x) const {
    constexpr Scalar slow = numeric::from_real<Scalar>(1e-12);
    const Scalar change =
        x * (numeric::abs(series.vibration[1]) + x * numeric::abs(series.motion(2)));
    const Scalar fastest = numeric::abs(series.velocity) + numeric::abs(series.rate) * change;
    return fastest < slow ? numeric::max(fastest, numeric::min(slow, slowest(series, x)))
                          : numeric::min(fastest, Scalar(1));
  }

  /// The vibration below which the rounding of the forces, on the way to x, exceeds what is
  /// allowed. Out of line: it is rare.
  [[gnu::noinline]] Scalar slowest(const Series& series, Scalar x) const {
    using Limits = std::numeric_limits<Scalar>;
    const Scalar forces =
        model_.force_moduli(numeric::abs(series.drive[0]) + numeric::abs(series.drive[1]),
                            {series.displacement, series.velocity, series.friction[0]});
    return numeric::max(Limits::epsilon() * (x * series.unit) * forces / allowed_,
                        Limits::min() / Limits::epsilon());
  }

  /// The larger of the weighted terms of V and phi, `before` orders below the last.
  Scalar last_term(const Series& series, std::size_t before, Scalar speed) const {
    Scalar motion = numeric::abs(series.rate * series.motion(last_power - before));
    if constexpr (moves) {
      motion = numeric::max(motion, load_term(series, last_power - before, speed));
    }
    if constexpr (!Law::varies) {
      return motion;
    }
    return numeric::max(motion,
                        speed * friction_weight() * numeric::abs(series.friction[Order - before]));
  }

  /// The n-th term of r. Its scale is that of r, or the other one if that is larger.
  static Scalar load_term(const Series& series, std::size_t n, Scalar speed) {
    const Scalar fastest =
        numeric::abs(series.sliding_velocity[0]) + numeric::abs(series.sliding_velocity[1]);
    const Scalar scale = numeric::max(speed, numeric::min(fastest, Scalar(1)));
    return numeric::abs(series.sliding_velocity[n]) * (speed / scale);
  }

  Scalar friction_weight() const {
    if constexpr (Law::rate_independent) {
      return numeric::clamp(model_.contact_force(Scalar(1)), least_weight, most_weight);
    }
    // Friction that depends on the speed follows from the series alone.
    return Law::remembers ? memory_weight : most_weight;
  }

  // ---- Where a step is cut ----

  /// The extent of the step, cut at the first reversal.
  static Scalar up_to_reversal(const Series& series, const Branch<Scalar>& branch, Scalar longest) {
    if constexpr (Law::reverses) {
      if (branch.zero_order > Order) {
        return longest;
      }
      const Scalar end = series.travel_rate(longest);
      if (longest <= Scalar(1) &&
          certainly_keeps_sign(series.travel, branch.direction, branch.zero_order, longest, end)) {
        return longest;
      }
      return first_reversal(series.travel, branch.direction, branch.zero_order, longest);
    }
    return longest;
  }

  /// The extent of the step, cut at the first corner of the law.
  static Scalar up_to_corner(const Series& series, const Arc& arc, Scalar direction,
                             Scalar longest) {
    if constexpr (Law::has_corners) {
      return corner(series, direction, arc.to_corner(), longest);
    }
    return longest;
  }

  /// Two reversals too close for time to tell them apart count as none: the contact slides on.
  static bool can_slide_beyond(const Branch<Scalar>& branch) {
    return Law::reverses && !Law::sticks && 0 < branch.zero_order && branch.zero_order < Order;
  }

  // ---- A sticking step ----

  template <class Account, class Observer>
  void stick(const IntervalOf<Model>& interval, const At& instant, const Branch<Scalar>& branch,
             Position& position, PlantState& state, Account& account, Observer& observer) {
    const Scalar rest_of_time = interval.duration - position.offset;
    Series series(model_, instant, numeric::min(longest_step_, rest_of_time));
    series.stick(model_);

    const Scalar remaining = rest_of_time / series.unit;
    const Scalar longest = step_extent(stick_term(series, Order), stick_term(series, Order - 1),
                                       Scalar(1), series, remaining);
    Scalar extent = longest;
    for (const Scalar side : {Scalar(1), Scalar(-1)}) {
      const std::size_t zero_order = side == branch.direction ? branch.zero_order : 0;
      if (zero_order <= Order) {
        Coefficients margin = series.friction;
        margin[0] -= side;
        const Scalar root =
            numeric::first_root(numeric::without_zero(margin, -side, zero_order), extent);
        position.released = root < extent ? side : position.released;
        extent = root;
      }
    }
    const HoldingFriction<Series> friction(series);
    accept(interval, series, friction, extent, extent == remaining, position, state, account,
           observer);
    rest(interval, position, state);
  }

  /// The n-th term of phi; of a load that of r too, over the scale of r.
  static Scalar stick_term(const Series& series, std::size_t n) {
    const Scalar holding = numeric::abs(series.friction[n]);
    if constexpr (moves) {
      constexpr Scalar slow = numeric::from_real<Scalar>(1e-12);
      const auto& r = series.sliding_velocity;
      const Scalar fastest = numeric::abs(r[0]) + numeric::abs(r[1]) + numeric::abs(r[2]);
      return numeric::max(holding, numeric::abs(r[n]) / numeric::clamp(fastest, slow, Scalar(1)));
    } else {
      return holding;
    }
  }

  /// The extent at which the last two terms reach what is allowed, or the rounding error of the
  /// velocity if that is larger. It is the unit itself if the unit was well chosen.
  Scalar step_extent(Scalar last, Scalar last_but_one, Scalar speed, const Series& series,
                     Scalar remaining) const {
    const Scalar rounding = std::numeric_limits<Scalar>::epsilon() * numeric::abs(series.velocity);
    const Scalar allowed = numeric::max(allowed_ * speed, rounding);
    const bool is_longest = series.unit == longest_step_ || remaining <= Scalar(1);
    if (is_longest && last <= allowed && last_but_one <= allowed) {
      return numeric::min(Scalar(1), remaining);
    }
    return numeric::min(reach(last, last_but_one, allowed),
                        numeric::min(longest_step_ / series.unit, remaining));
  }

  /// The extent, within 8 %, at which terms of the two highest orders reach what is allowed.
  static Scalar reach(Scalar last, Scalar last_but_one, Scalar allowed) {
    return numeric::min(numeric::quick_root_of_quotient<degree>(allowed, last),
                        numeric::quick_root_of_quotient<degree - 1>(allowed, last_but_one));
  }

  // ---- The end of a step ----

  template <class Friction, class Account, class Observer>
  void accept(const IntervalOf<Model>& interval, const Series& series, const Friction& friction,
              Scalar extent, bool last, Position& position, PlantState& state, Account& account,
              Observer& observer) {
    const TaylorStep<Model, Series, Friction> taken(model_, series, friction, position.offset,
                                                    extent);
    static_cast<typename Model::Motion&>(state) = taken.end();
    if constexpr (Law::remembers) {
      state.memory = friction.memory(extent);
    }
    account.add(taken);
    observer(taken);
    position.offset = last ? interval.duration : position.offset + taken.length();
    ++cost_.steps;
  }

  void rest(const IntervalOf<Model>& interval, const Position& position, PlantState& state) {
    state.velocity = model_.resting_velocity(sliding_velocity(interval, position, state));
    ++cost_.events;
  }

  Model model_;
  Scalar allowed_ = Scalar(0);  ///< of the last two terms of a step
  Scalar longest_step_ = Scalar(0);
  std::uint32_t step_limit_ = max_steps_per_advance;
  Cost cost_;
};

}  // namespace sonoglide::plant
