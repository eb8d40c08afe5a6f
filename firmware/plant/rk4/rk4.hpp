/// Classical Runge–Kutta method of fourth order with a fixed step, as the paper uses it.
#pragma once

#include <cstdint>

#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/outcome.hpp"
#include "firmware/plant/rk4/rk4_formula.hpp"
#include "firmware/plant/rk4/rk4_step.hpp"
#include "firmware/plant/state.hpp"

namespace sonoglide::plant {

/// Fixed steps that do not look for reversals (tableau: rk4_formula.hpp).
///
/// A reversal inside a step costs the fourth order: the error of the mean friction falls as the
/// square of the step under Dahl, in proportion to the step under Coulomb. Stable in a stiff
/// contact only for step <= 2.785 / (kappa |V|); beyond it |phi| passes 1, which is reported.
template <class ModelType>
class Rk4 {
 public:
  using Model = ModelType;
  using Scalar = typename Model::Scalar;
  template <class Law>
  static constexpr bool solves = !Law::has_corners;

  /// step: the longest allowed, in tau; > 0. An interval is cut into equal steps.
  /// step_limit: the most steps of one advance.
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
  Outcome<Scalar> advance(const IntervalOf<Model>& interval, typename Model::PlantState& state,
                          Account& account, Observer& observer) {
    const std::uint32_t count = fixed_step_count(interval.duration, step_, step_limit_);
    if (count > step_limit_) {
      return {Error::too_many_steps, Scalar(0)};
    }
    if (count == 0) {
      return {Error::none, interval.duration};
    }
    const Scalar length = interval.duration / static_cast<Scalar>(count);
    if (!oscillator_is_stable(model_, length)) {
      return {Error::step_too_long, Scalar(0)};
    }
    const Formula formula(model_, interval, TurningContact());
    Samples drive(interval.drive_amplitude, interval.phase_begin, length / Scalar(2));
    Stage begin = formula.stage(drive.value(), Scalar(0), state);
    for (std::uint32_t i = 0; i < count; ++i) {
      begin =
          step(formula, drive, begin, length * static_cast<Scalar>(i), length, account, observer);
      state = begin.state;
      const Error error = check_state(model_.law, state);
      if (error != Error::none) {
        return {error, length * static_cast<Scalar>(i + 1)};
      }
    }
    return {Error::none, interval.duration};
  }

  const Cost& cost() const { return cost_; }

 private:
  using Formula = Rk4Formula<Model, TurningContact>;
  using Samples = typename Model::Drive::template Samples<Scalar>;
  using Stage = typename Formula::Stage;

  /// The stage at the end of a step from the stage at its beginning.
  template <class Account, class Observer>
  Stage step(const Formula& formula, Samples& drive, const Stage& begin, Scalar offset,
             Scalar length, Account& account, Observer& observer) {
    drive.next();
    const Scalar middle = drive.value();
    drive.next();
    const typename Formula::Stages stages =
        formula.stages(begin, {begin.drive, middle, drive.value()}, offset, length);
    const Rk4Step<Model> taken(model_, stages.inside, stages.end, offset, length);
    account.add(taken);
    observer(taken);
    ++cost_.steps;
    return stages.end;
  }

  Model model_;
  Scalar step_ = Scalar(0);
  std::uint32_t step_limit_ = max_steps_per_advance;
  Cost cost_;
};

}  // namespace sonoglide::plant
