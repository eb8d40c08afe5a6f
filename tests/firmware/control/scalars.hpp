/// The arithmetics that every part of the controller is tested in.
#pragma once

#include <gtest/gtest.h>

#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

using Saturated = numeric::Q31<numeric::Saturating>;
/// Stops the program at the first overflow: what runs in it has none.
using Trapped = numeric::Q31<numeric::Trapping>;

/// The same in 16 bits.
using ShortTrapped = numeric::Q15<numeric::Trapping>;

using Scalars = testing::Types<double, float, Saturated, Trapped>;
using FloatingScalars = testing::Types<double, float>;

template <class Scalar>
Scalar scaled(double value) {
  return numeric::from_real<Scalar>(value);
}

/// Distance from 1 to the next value below, or one unit of the last place in fixed point.
template <class Scalar>
double resolution() {
  if constexpr (numeric::is_fixed_point_v<Scalar>) {
    return numeric::from_code<double>(1);
  } else {
    return static_cast<double>(std::numeric_limits<Scalar>::epsilon());
  }
}

}  // namespace sonoglide::control
