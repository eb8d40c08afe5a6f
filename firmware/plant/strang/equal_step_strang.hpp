/// Strang splitting: an oscillator that is exact without its contact, a contact that is exact in
/// the displacement.
#pragma once

#include <cstdint>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/outcome.hpp"
#include "firmware/plant/state.hpp"
#include "firmware/plant/strang/oscillator_flow.hpp"
#include "firmware/plant/strang/strang_step.hpp"

namespace sonoglide::plant {

/// Symmetric splitting (Strang 1968, ../README.md) with a fixed step: half a kick of friction; the
/// oscillator's own flow, along which the contact follows its law in displacement; half a kick.
///
///     v += -h/2 beta phi  |  exp(h L) of y, v, drive; phi along the path  |  v += -h/2 beta phi'
///     K(h/2)              |  F(h)                                         |  K(h/2)
///
/// Second order in step^2 beta. Without reaction of friction (beta = 0) the motion is exact, and
/// the friction is as good as the displacement at its reversals, O(step^6). |phi| <= 1 for any
/// step. The step is at most 1 / sqrt(beta kappa), at which the ringing of a stuck contact is
/// stable and 5 % fast. In a stiff contact the friction jumps at a reversal, and the kicks place
/// the jump to within a step only: first order in step beta.
template <class ModelType>
class EqualStepStrang {
 public:
  using Model = ModelType;
  using Scalar = typename Model::Scalar;
  template <class Law>
  static constexpr bool solves = !Law::sticks && Law::rate_independent && !Law::remembers;
  static_assert(
      solves<typename Model::FrictionLaw>,
      "the contact follows its law in displacement; one that sticks makes the kicks chatter");

  /// step: the longest allowed, in tau; > 0. An interval is cut into equal steps.
  /// step_limit: the most steps of one advance.
  void configure(const Model& model, Scalar step,
                 std::uint32_t step_limit = max_steps_per_advance) {
    model_ = model;
    const Scalar stuck_stiffness = model.contact_force(model.law.rate(Scalar(1), Scalar(0)));
    const bool rings = stuck_stiffness * step * step > Scalar(1);
    step_ = rings ? Scalar(1) / numeric::sqrt(stuck_stiffness) : step;
    step_limit_ = step_limit;
    flow_ = Flow();
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
    const Scalar length = interval.duration / static_cast<Scalar>(count);
    if (count > 0 && flow_.length() != length) {
      flow_ = Flow(model_, length);
    }
    typename Flow::Follower drive(interval);
    state.friction = model_.law.friction(Scalar(0), state.friction);
    for (std::uint32_t i = 0; i < count; ++i) {
      const StrangStep<Model> taken(model_, flow_, interval, drive, length * static_cast<Scalar>(i),
                                    state);
      state = taken.end();
      account.add(taken);
      observer(taken);
      ++cost_.steps;
      cost_.events += taken.reversals();
      const Error error = check_state(state);
      if (error != Error::none) {
        return {error, length * static_cast<Scalar>(i + 1)};
      }
    }
    return {Error::none, interval.duration};
  }

  const Cost& cost() const { return cost_; }

 private:
  using Law = typename Model::FrictionLaw;
  using Flow = OscillatorFlow<Model>;

  Model model_;
  Scalar step_ = Scalar(0);
  std::uint32_t step_limit_ = max_steps_per_advance;
  Flow flow_;
  Cost cost_;
};

}  // namespace sonoglide::plant
