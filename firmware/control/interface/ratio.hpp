/// The friction ratio of an undriven contact, ρ = 1, on the base 2 of all ratios.
#pragma once

#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// ρ = 1: half of full scale in fixed point, exact in every arithmetic.
template <class Scalar>
constexpr Scalar whole_ratio = numeric::from_real<Scalar>(0.5);

/// ρ >= 1, which needs no drive; of a NaN nothing is said.
/// @param half_ratio  ρ on base 2
template <class Scalar>
constexpr bool is_whole(Scalar half_ratio) {
  return numeric::reaches(half_ratio, whole_ratio<Scalar>);
}

}  // namespace sonoglide::control
