/// What every step is held to, whatever the method.
#pragma once

#include <limits>

#include "firmware/numeric/scalar.hpp"
#include "firmware/plant/outcome.hpp"
#include "firmware/plant/state.hpp"

namespace sonoglide::plant {

/// |phi| <= 1 but for rounding.
template <class Scalar>
inline constexpr Scalar largest_friction = Scalar(1) +
                                           Scalar(64) * std::numeric_limits<Scalar>::epsilon();

/// A finite state within that bound.
template <class Scalar>
Error check_state(const State<Scalar>& state) {
  if (!is_finite(state)) {
    return Error::not_finite;
  }
  return numeric::abs(state.friction) <= largest_friction<Scalar> ? Error::none
                                                                  : Error::friction_bound_broken;
}

/// Whether a step keeps the classical Runge–Kutta formula stable on the oscillator alone:
/// |h| sqrt(|k|) <= 2 sqrt(2) and h d <= 2.785.
template <class Model, class Scalar>
bool oscillator_is_stable(const Model& model, Scalar step) {
  return step * step * numeric::abs(model.stiffness) <= Scalar(8) &&
         model.damping_force(step) <= numeric::from_real<Scalar>(2.785);
}

}  // namespace sonoglide::plant
