/// The friction ratio of an undriven contact, ρ = 1, on the base 2 of all ratios.
#pragma once

#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

template <class Scalar>
constexpr Scalar whole_ratio = numeric::from_real<Scalar>(0.5);

/// Of a ratio of 1 or more: it needs no drive.
template <class Scalar>
constexpr bool is_whole(Scalar half_ratio) {
  return numeric::reaches(half_ratio, whole_ratio<Scalar>);
}

}  // namespace sonoglide::control
