/// Result and cost of an advance of a solver, and the check of the state after every step.
#pragma once

#include <cstdint>
#include <limits>

#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/state.hpp"

namespace sonoglide::plant {

enum class Error {
  none,
  not_finite,             ///< displacement, velocity or friction is, or would be, no number
  friction_bound_broken,  ///< |phi| > 1: the step is too long for the contact
  too_many_steps,         ///< the step limit of an advance was reached
  step_too_long,          ///< for the contact or the oscillator, seen before the state shows it
};

/// After an error the state is that of `offset`: for too_many_steps, step_too_long and a step that
/// could not be begun the last one reached, otherwise the first one that is wrong.
template <class Scalar>
struct Outcome {
  Error error = Error::none;
  Scalar offset = Scalar(0);  ///< time since the interval began; its duration if there is no error
};

/// Totals since the solver was configured.
struct Cost {
  std::uint64_t steps = 0;
  std::uint64_t events = 0;  ///< reversals of the sliding velocity, sticks and releases
};

inline constexpr std::uint32_t max_steps_per_advance = 1000000;

// The check of the state after every step, whatever the method.

/// |phi| <= 1 but for rounding.
template <class Scalar>
inline constexpr Scalar largest_friction = Scalar(1) +
                                           Scalar(64) * std::numeric_limits<Scalar>::epsilon();

/// Checks that the state is finite and |phi| within that bound. A bounded phi is finite, so the
/// usual state needs no further test.
template <class Scalar>
Error check_state(const State<Scalar>& state) {
  if (numeric::abs(state.friction) <= largest_friction<Scalar> &&
      numeric::is_finite(state.displacement) && numeric::is_finite(state.velocity)) {
    return Error::none;
  }
  return is_finite(state) ? Error::friction_bound_broken : Error::not_finite;
}

/// The same check for a plant with this law. A force that depends on the speed has no bound, but
/// its Memory may have one. A force that is a sign keeps its bound by itself.
template <class Law>
Error check_state(const Law& /*law*/, const State<typename Law::Scalar>& state) {
  if constexpr (Law::rate_independent && Law::varies) {
    return check_state(state);
  }
  return is_finite(state) ? Error::none : Error::not_finite;
}
template <class Law>
Error check_state(const Law& law, const LoadedState<typename Law::Scalar>& state) {
  const State<typename Law::Scalar>& oscillator = state;
  return is_finite(state) ? check_state(law, oscillator) : Error::not_finite;
}
template <class Law, class Motion>
Error check_state(const Law& law, const RememberingState<Law, Motion>& state) {
  using Scalar = typename Law::Scalar;
  const Scalar rounding = Scalar(64) * std::numeric_limits<Scalar>::epsilon();
  const Scalar bound = law.largest_memory() * (Scalar(1) + rounding);
  if (!is_finite(state)) {
    return Error::not_finite;
  }
  return numeric::abs(state.memory) <= bound ? Error::none : Error::friction_bound_broken;
}

/// Whether a step keeps the classical Runge–Kutta formula stable on the oscillator alone:
/// |h| sqrt(|k|) <= 2 sqrt(2) and h d <= 2.785; and on a load alone.
template <class Model, class Scalar>
bool oscillator_is_stable(const Model& model, Scalar step) {
  constexpr Scalar most_damping = numeric::from_real<Scalar>(2.785);
  if constexpr (Model::Sliding::moves) {
    if (step * step * model.load_stiffness > Scalar(8) ||
        step * model.load_damping > most_damping) {
      return false;
    }
  }
  return step * step * numeric::abs(model.stiffness) <= Scalar(8) &&
         model.damping_force(step) <= most_damping;
}

}  // namespace sonoglide::plant
