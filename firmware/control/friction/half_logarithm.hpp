/// Logarithms of quotients near 1, and what they are the logarithms of.
#pragma once

#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// 1/x, x > 0.
template <class Scalar>
numeric::Floating<Scalar> inverse_of(Scalar x) {
  constexpr Scalar one_half = numeric::from_real<Scalar>(0.5);
  return numeric::rescaled(numeric::quotient(numeric::floating(one_half), numeric::floating(x)), 1);
}

template <class Scalar>
Scalar third_of_cube(Scalar x) {
  constexpr Scalar third = numeric::from_real<Scalar>(1.0 / 3.0);
  return numeric::rough_product(numeric::rough_product(x, third), numeric::rough_product(x, x));
}

/// ln(a/b)/2 = u + u³/3, u = (a − b)/(a + b), u limited to ±0.6; a + b > 2^-11. Too small by at most 0.3 %
/// where a/b is up to 2, by 0.06 % up to 1.6.
template <class Scalar>
Scalar half_log(Scalar a, Scalar b) {
  constexpr Scalar least = numeric::from_real<Scalar>(0x1p-12);
  const Scalar sum = numeric::max(numeric::half_sum(a, b), least);
  const Scalar u = numeric::clamp_magnitude(
      numeric::limited_product(numeric::half_difference(a, b), inverse_of(sum)),
      numeric::from_real<Scalar>(0.6));
  return u + third_of_cube(u);
}

/// e^2x = (1 + tanh x)/(1 − tanh x), tanh x = x − x³/3; |x| <= 1/2. Within 1 % of it at the ends, 0.03 %
/// at 1/4.
template <class Scalar>
numeric::Floating<Scalar> exponential_of_twice(Scalar x) {
  constexpr Scalar one_half = numeric::from_real<Scalar>(0.5);
  const Scalar tangent = numeric::half(x - third_of_cube(x));
  return numeric::quotient(numeric::floating(one_half + tangent),
                           numeric::floating(one_half - tangent));
}

}  // namespace sonoglide::control
