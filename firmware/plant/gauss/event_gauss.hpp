/// A solver for weakly coupled contacts: one panel for each carrier period.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/turn.hpp"
#include "firmware/numeric/vector_unit.hpp"
#include "firmware/plant/gauss/gauss_panel.hpp"
#include "firmware/plant/gauss/gauss_step.hpp"
#include "firmware/plant/outcome.hpp"
#include "firmware/plant/state.hpp"
#include "firmware/plant/taylor/event_taylor.hpp"

namespace sonoglide::plant {

/// Gauss quadrature of friction between the reversals of the sliding velocity, about the linear
/// motion of the oscillator.
///
///     x     -1            r1              r2           1     one panel: a carrier period
///            |--.--.--.--.|-.--.--.--.--.-|-.--.--.--.-|
///     sgn V        +             -              +            nodes of each piece between reversals
///
///     y(x) = linear(x) + beta h^2 (C(x) int S phi / W - S(x) int C phi / W)
///
/// An interval of one carrier period is one panel. Its motion without friction is a sum of known
/// motions, and a table shows the reversals of that sum. Between two reversals friction is exact in
/// the displacement, and acts on the motion by variation of constants at `Nodes` nodes (Hairer
/// 1993, I.11). The Taylor method takes the interval from beginning to end if it has another
/// length, if friction is not weak, if a reversal is not certain, if the motion is lost in the
/// rounding of the displacement, or if the error seems to exceed the tolerance. |phi| <= 1 always.
///
/// 8 nodes are quickest at tolerances down to 1e-8, 12 below that; float needs 8.
template <class ModelType, std::size_t Nodes>
class EventGauss {
  static_assert(Nodes == 8 || Nodes == 12, "degrees are chosen for these");

 public:
  using Model = ModelType;
  using Scalar = typename Model::Scalar;

  /// Friction laws that it can solve: force by the displacement alone, no stick, no further memory.
  template <class Law>
  static constexpr bool solves =
      !Law::sticks && Law::varies && Law::rate_independent && !Law::remembers;

  /// tolerance: as of EventTaylor. Error of the mean friction over a hundred carrier periods,
  /// relative to Fc, and of the velocity, in units of its scale; > 0.
  /// step_limit: the most steps that one advance may take.
  void configure(const Model& model, Scalar tolerance,
                 std::uint32_t step_limit = max_steps_per_advance) {
    model_ = model;
    motions_ = Motions(model, half_period);
    rounding_ = numeric::max(tolerance, Scalar(16) * std::numeric_limits<Scalar>::epsilon());
    is_weak_ = set_limits(tolerance);
    taylor_.configure(model, tolerance, step_limit);
    cost_ = Cost();
  }

  /// Advances the state over the interval, adding every step to the account and showing it to the
  /// observer.
  template <class Account, class Observer>
  Outcome<Scalar> advance(const IntervalOf<Model>& interval, State<Scalar>& state, Account& account,
                          Observer& observer) {
    const Scalar beyond = interval.duration - numeric::twice(half_period);
    if (is_weak_ && numeric::abs(beyond) <= rounding_) {
      if (solve(interval, state)) {
        const GaussStep<Model, Panel> taken(model_, motions_, panel_, interval, state);
        state = panel_.end();
        account.add(taken);
        observer(taken);
        ++cost_.steps;
        cost_.events += panel_.reversals();
        return {Error::none, interval.duration};
      }
    }
    return taylor_.advance(interval, state, account, observer);
  }

  /// Another set of instructions than the best that the machine has; it must have it. The same bits.
  void use(numeric::VectorUnit unit) { vector_unit_ = unit; }

  Cost cost() const {
    return {cost_.steps + taylor_.cost().steps, cost_.events + taylor_.cost().events};
  }

 private:
  static constexpr bool is_single = std::numeric_limits<Scalar>::digits <= 24;
  static constexpr std::size_t degree = Nodes == 8 ? 15 : 19;
  static constexpr std::size_t slow_degree = Nodes == 8 ? 7 : 9;
  static constexpr std::size_t taylor_order = is_single ? 8 : Nodes == 8 ? 12 : 16;
  /// The quadrature misses the coefficient of degree about 2 Nodes. For exp(-E x^2) this is the
  /// square of the last coefficient over the middle binomial coefficient of Nodes; 10 was found by
  /// trial.
  static constexpr Scalar middle_binomial = Nodes == 8 ? Scalar(70) : Scalar(924);
  static constexpr Scalar half_period = numeric::from_real<Scalar>(0.5 * numeric::two_pi);

  using Panel = GaussPanel<Model, Nodes, degree, slow_degree>;
  using Motions = typename Panel::Motions;

  /// Compiled for each set of vector instructions: with the latest a panel takes a fifth less time.
  bool solve(const IntervalOf<Model>& interval, const State<Scalar>& state) {
#ifdef SONOGLIDE_VECTOR_UNITS
    switch (vector_unit_) {
      case numeric::VectorUnit::avx512:
        return solve_avx512(interval, state);
      case numeric::VectorUnit::avx2:
        return solve_avx2(interval, state);
      case numeric::VectorUnit::any:
        break;
    }
#endif
    return panel_.solve(model_, motions_, limits_, interval, state);
  }
#ifdef SONOGLIDE_VECTOR_UNITS
  [[gnu::target("avx512f,avx512dq,avx512vl")]] bool solve_avx512(const IntervalOf<Model>& interval,
                                                                 const State<Scalar>& state) {
    return panel_.solve(model_, motions_, limits_, interval, state);
  }
  [[gnu::target("avx2")]] bool solve_avx2(const IntervalOf<Model>& interval,
                                          const State<Scalar>& state) {
    return panel_.solve(model_, motions_, limits_, interval, state);
  }
#endif

  /// Returns false if friction is not weak, or if the series of the motions are too short.
  bool set_limits(Scalar tolerance) {
    const Scalar kappa = model_.law.contact_stiffness;
    const Scalar reach = numeric::max(kappa, Scalar(1));
    const Scalar share = numeric::from_real<Scalar>(0.125) * tolerance;
    const Scalar force = model_.contact_force(half_period * half_period) *
                         numeric::exp(numeric::abs(motions_.damping));
    const Scalar c = motions_.largest[0];
    const Scalar s = motions_.largest[1];
    const auto& [c_rate, s_rate] = motions_.largest_rate;
    // c and s of the reaction stay below 2 force max|S| and 2 force max|C|.
    const Scalar shift = Scalar(4) * force * c * s;
    limits_.velocity_share = numeric::twice(force) * (s * c_rate + c * s_rate);
    limits_.slope_share = force + numeric::abs(motions_.stiffness) * shift +
                          numeric::abs(motions_.damping) * limits_.velocity_share;
    limits_.path_error = share / reach;
    limits_.largest_offset = rounding_ / std::numeric_limits<Scalar>::epsilon();
    limits_.turn_error = share / reach;
    // At 4 nodes the error of exp(-E x^2) is about E^4 / 10^6. They are used where it is less than
    // that.
    limits_.short_exponent = numeric::min(numeric::from_real<Scalar>(0.25),
                                          Scalar(25) * numeric::sqrt(numeric::sqrt(tolerance)));
    limits_.unresolved = Scalar(10) * tolerance * middle_binomial;
    set_sweeps(tolerance, force);
    const Scalar exponent = kappa * shift;
    const Scalar square = exponent * exponent;
    const Scalar slow_error = motions_.slow_error * reach * Scalar(8) * force * numeric::max(c, s);
    return square * square <= Scalar(3) * tolerance && slow_error <= share;
  }

  /// After n sweeps the mean error of phi is about the (n + 1)-th power of kappa beta length^2 over
  /// 8, 200 and 10000. The error of the displacement is that over kappa.
  void set_sweeps(Scalar tolerance, Scalar force) {
    constexpr Scalar smallest = std::numeric_limits<Scalar>::min();
    const Scalar kappa = numeric::max(model_.law.contact_stiffness, smallest);
    const Scalar ratio = numeric::min(Scalar(1), numeric::twice(kappa));
    const Scalar curvature =
        Scalar(1) + numeric::abs(motions_.stiffness) + numeric::abs(motions_.damping);
    const Scalar inverse = Scalar(1) / numeric::max(kappa * force * curvature, smallest);
    const Scalar allowed = ratio * tolerance;
    limits_.sweep_length = {Scalar(4) * allowed * inverse,
                            Scalar(10) * numeric::sqrt(allowed) * inverse,
                            Scalar(10) * numeric::quick_root<3>(allowed) * inverse};
  }

  Model model_;
  Motions motions_;
  PanelLimits<Scalar> limits_;
  Scalar rounding_ = Scalar(0);  ///< by which the length of a panel, or its motion, may be wrong
  bool is_weak_ = false;
  Panel panel_;  ///< the last one, and where the next is written
  EventTaylor<Model, taylor_order> taylor_;
  Cost cost_;
  numeric::VectorUnit vector_unit_ = numeric::best_vector_unit();
};

}  // namespace sonoglide::plant
