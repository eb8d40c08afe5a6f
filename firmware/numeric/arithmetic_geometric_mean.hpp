/// Arithmetic-geometric mean of float and double.
#pragma once

#include <limits>

#include "firmware/numeric/float_sqrt.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::numeric {

/// Common limit of a, b -> (a + b)/2, sqrt(a b). The complete elliptic integral of the first kind
/// is K(k) = (pi/2) / mean(1, sqrt(1 - k^2)).
///
/// @param a, b  > 0, their product neither overflowing nor underflowing.
/// Error <= 4 units in the last place (tested against Boost's ellint_1).
/// Source: C. F. Gauss; B. C. Carlson, American Mathematical Monthly 78 (1971) 496-505.
template <class Float>
constexpr Float arithmetic_geometric_mean(Float a, Float b) {
  // The limit lies within (a - b)^2 / 16 a of (a + b)/2: less than a rounding from here on.
  constexpr Float near = power_of_two<Float>(-std::numeric_limits<Float>::digits / 2);
  while (abs(a - b) > near * a) {
    const Float geometric = sqrt(a * b);
    a = half(a + b);
    b = geometric;
  }
  return half(a + b);
}

}  // namespace sonoglide::numeric
