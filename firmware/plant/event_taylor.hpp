/// The default solver: Taylor series between the reversals of the sliding velocity.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/branch_at_rest.hpp"
#include "firmware/plant/first_root.hpp"
#include "firmware/plant/outcome.hpp"
#include "firmware/plant/state.hpp"
#include "firmware/plant/step_size.hpp"
#include "firmware/plant/taylor_series.hpp"
#include "firmware/plant/taylor_step.hpp"

namespace sonoglide::plant {

/// Taylor method of fixed order whose steps end at the reversals of the sliding velocity.
///
/// Inside a step sgn V is constant and the motion analytic. The step is the longest, up to 1.5 rad,
/// whose last two terms of the velocity (and of 1 - |phi|, or of phi in a stick) stay below the
/// tolerance. The first root of V is found with certainty; the step ends there, V is set to zero
/// and the contact slides on, turns or sticks. Friction follows from the displacement exactly, so
/// |phi| <= 1 for any step.
///
/// Order 8 suits a relative error of 1e-4 and float, 12 suits 1e-8, 16 anything below 1e-10.
/// The cost of a contact stuck without end grows as sqrt(beta kappa): its ringing is resolved.
template <class ModelType, std::size_t Order>
class EventTaylor {
  static_assert(Order >= 4 && Order <= 24, "the tables reach order 24");

 public:
  using Model = ModelType;
  using Scalar = typename Model::Scalar;

  /// tolerance: of each step, absolute, in units of the velocity scale; > 0.
  void configure(const Model& model, Scalar tolerance) {
    model_ = model;
    tolerance_ = tolerance;
    cost_ = Cost();
  }

  /// Advances the state over the interval, adding every step to the account and showing it to the
  /// observer.
  template <class Account, class Observer>
  Outcome<Scalar> advance(const Interval<Scalar>& interval, State<Scalar>& state, Account& account,
                          Observer& observer) {
    snap_to_rest(interval, state);
    Position position = {Scalar(0), Scalar(0)};
    for (std::uint32_t steps = 0; position.offset < interval.duration; ++steps) {
      if (steps == max_steps_per_advance) {
        return {Error::too_many_steps, position.offset};
      }
      step(interval, position, state, account, observer);
      if (!is_finite(state)) {
        return {Error::not_finite, position.offset};
      }
    }
    return {Error::none, interval.duration};
  }

  const Cost& cost() const { return cost_; }

 private:
  using Law = typename Model::FrictionLaw;
  using At = Instant<Model>;
  using Drive = typename Model::Drive::template Phasor<Scalar>;
  using Arc = typename Law::template Arc<Order>;
  using Series = TaylorSeries<Model, Order>;
  using Coefficients = typename Series::Coefficients;

  struct Position {
    Scalar offset;
    Scalar released;  ///< direction in which a stick has just ended, else 0
  };

  static constexpr Scalar longest_step = numeric::from_real<Scalar>(1.5);

  /// Where the previous interval ended at V = 0, V is zero here but for rounding.
  void snap_to_rest(const Interval<Scalar>& interval, State<Scalar>& state) const {
    if constexpr (Law::reverses) {
      const Scalar velocity = model_.contact_velocity(interval.sliding_velocity, state.velocity);
      const Scalar rounding = Scalar(4) * std::numeric_limits<Scalar>::epsilon();
      if (numeric::abs(velocity) <= rounding * numeric::abs(interval.sliding_velocity)) {
        state.velocity = model_.resting_velocity(interval.sliding_velocity);
      }
    }
  }

  template <class Account, class Observer>
  void step(const Interval<Scalar>& interval, Position& position, State<Scalar>& state,
            Account& account, Observer& observer) {
    const Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
    const Scalar change = interval.sliding_acceleration * position.offset;
    const Scalar phase = interval.phase_begin + position.offset;
    const At instant = {Drive(interval.drive_amplitude, phase),
                        interval.sliding_velocity + change,
                        interval.sliding_acceleration,
                        epsilon * (Scalar(16) + numeric::twice(phase)),
                        epsilon * (numeric::abs(interval.sliding_velocity) + numeric::abs(change)),
                        state};
    Branch<Scalar> branch = choose_branch(instant, position.released);
    position.released = Scalar(0);
    if constexpr (Law::sticks) {
      if (branch.sticks) {
        stick(interval, instant, branch, position, state, account, observer);
        return;
      }
    }
    while (!slide(interval, instant, branch, position, state, account, observer)) {
      branch = {false, -branch.direction, branch.zero_order + 1};
    }
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

  /// False, with nothing done, where the next reversal is too close for time to move.
  template <class Account, class Observer>
  bool slide(const Interval<Scalar>& interval, const At& instant, const Branch<Scalar>& branch,
             Position& position, State<Scalar>& state, Account& account, Observer& observer) {
    const Scalar velocity =
        model_.contact_velocity(instant.sliding_velocity, instant.state.velocity);
    Series series(instant, model_.law.series_unit(velocity, state.friction));
    Arc arc(model_.law, branch.direction, state.friction);
    series.slide(model_, arc);

    const Scalar remaining = (interval.duration - position.offset) / series.unit;
    const Scalar longest = step_extent(
        numeric::max(numeric::abs(series.velocity[Order]), arc.magnitude(Order)),
        numeric::max(numeric::abs(series.velocity[Order - 1]), arc.magnitude(Order - 1)), series,
        remaining);
    Scalar extent = longest;
    if constexpr (Law::reverses) {
      if (branch.zero_order <= Order) {
        extent = first_root(
            without_zero(series.contact_velocity, branch.direction, branch.zero_order), longest);
      }
    }
    const bool stands_still =
        extent < longest && position.offset + extent * series.unit == position.offset;
    if (stands_still && can_slide_beyond(branch)) {
      return false;
    }
    const SlidingFriction<Series, Arc> friction(series, arc, branch.direction);
    accept(interval, series, friction, extent, extent == remaining, position, state, account,
           observer);
    if constexpr (Law::reverses) {
      if (extent < longest) {
        rest(interval, position, state);
      }
    }
    return true;
  }

  /// Two reversals closer than time can tell are none: the contact slides on beyond them.
  static bool can_slide_beyond(const Branch<Scalar>& branch) {
    return Law::reverses && !Law::sticks && 0 < branch.zero_order && branch.zero_order < Order;
  }

  template <class Account, class Observer>
  void stick(const Interval<Scalar>& interval, const At& instant, const Branch<Scalar>& branch,
             Position& position, State<Scalar>& state, Account& account, Observer& observer) {
    Series series(instant, Scalar(1));
    series.stick(model_);

    const Scalar remaining = interval.duration - position.offset;
    const Scalar longest = step_extent(numeric::abs(series.friction[Order]),
                                       numeric::abs(series.friction[Order - 1]), series, remaining);
    Scalar extent = longest;
    for (const Scalar side : {Scalar(1), Scalar(-1)}) {
      const std::size_t zero_order = side == branch.direction ? branch.zero_order : 0;
      if (zero_order <= Order) {
        Coefficients margin = series.friction;
        margin[0] -= side;
        const Scalar root = first_root(without_zero(margin, -side, zero_order), extent);
        position.released = root < extent ? side : position.released;
        extent = root;
      }
    }
    const HoldingFriction<Series> friction(series);
    accept(interval, series, friction, extent, extent == remaining, position, state, account,
           observer);
    rest(interval, position, state);
  }

  /// direction p(x) / x^zero_order.
  static Coefficients without_zero(const Coefficients& p, Scalar direction,
                                   std::size_t zero_order) {
    Coefficients quotient{};
    for (std::size_t n = zero_order; n <= Order; ++n) {
      quotient[n - zero_order] = direction * p[n];
    }
    return quotient;
  }

  /// The extent, within 7 %, at which the last two terms reach the tolerance, or the rounding error
  /// of the velocity if that is larger.
  Scalar step_extent(Scalar last, Scalar last_but_one, const Series& series,
                     Scalar remaining) const {
    constexpr int degree = static_cast<int>(Order);
    const Scalar smallest = std::numeric_limits<Scalar>::min();
    const Scalar allowed = numeric::max(
        tolerance_, std::numeric_limits<Scalar>::epsilon() * numeric::abs(series.velocity[0]));
    const Scalar extent =
        numeric::min(quick_root<degree>(allowed / numeric::max(last, smallest)),
                     quick_root<degree - 1>(allowed / numeric::max(last_but_one, smallest)));
    return numeric::min(extent, numeric::min(longest_step / series.unit, remaining));
  }

  template <class Friction, class Account, class Observer>
  void accept(const Interval<Scalar>& interval, const Series& series, const Friction& friction,
              Scalar extent, bool last, Position& position, State<Scalar>& state, Account& account,
              Observer& observer) {
    const TaylorStep<Model, Series, Friction> taken(model_, series, friction, position.offset,
                                                    extent);
    state = taken.end();
    account.add(taken);
    observer(taken);
    position.offset = last ? interval.duration : position.offset + taken.length();
    ++cost_.steps;
  }

  void rest(const Interval<Scalar>& interval, const Position& position, State<Scalar>& state) {
    state.velocity = model_.resting_velocity(interval.sliding_velocity +
                                             interval.sliding_acceleration * position.offset);
    ++cost_.events;
  }

  Model model_;
  Scalar tolerance_ = Scalar(0);
  Cost cost_;
};

}  // namespace sonoglide::plant
