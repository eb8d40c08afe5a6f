/// The first reversal in a single lane, for the lanes whose reversal is a close call.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "firmware/numeric/first_root.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::batch {

/// The first zero of p = |V| within (0, end), certified, or `end`; p[0] >= 0, and where it is zero
/// that zero does not count. Not a number where the polynomial is not made of finite ones.
template <class Scalar, std::size_t Count>
Scalar certain_reversal(std::array<Scalar, Count> p, Scalar end) {
  Scalar sum = end;
  for (const Scalar coefficient : p) {
    sum += numeric::abs(coefficient);
  }
  if (!numeric::is_finite(sum)) {
    return std::numeric_limits<Scalar>::quiet_NaN();
  }
  if (p[0] == Scalar(0)) {
    for (std::size_t n = 1; n < Count; ++n) {
      p[n - 1] = p[n];
    }
    p[Count - 1] = Scalar(0);
  }
  return numeric::first_root(p, end);
}

}  // namespace sonoglide::batch
