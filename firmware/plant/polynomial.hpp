/// Polynomials given by their coefficients, lowest power first.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/numeric/scalar.hpp"

namespace sonoglide::plant {

namespace detail {

inline constexpr std::size_t reciprocal_count = 64;

template <class Scalar>
constexpr std::array<Scalar, reciprocal_count> make_reciprocals() {
  std::array<Scalar, reciprocal_count> table{};
  for (std::size_t n = 1; n < reciprocal_count; ++n) {
    table[n] = numeric::from_real<Scalar>(1.0 / static_cast<double>(n));
  }
  return table;
}

template <class Scalar>
inline constexpr std::array<Scalar, reciprocal_count> reciprocals = make_reciprocals<Scalar>();

}  // namespace detail

/// 1 / n for n in [1, 63], without a division.
template <class Scalar>
constexpr Scalar reciprocal(std::size_t n) {
  return detail::reciprocals<Scalar>[n];
}

/// p(x): even and odd powers are two chains that do not wait for each other.
template <class Scalar, std::size_t Count>
Scalar evaluate(const std::array<Scalar, Count>& p, Scalar x) {
  const Scalar square = x * x;
  std::array<Scalar, 2> chains = {p[Count - 1], p[Count - 2]};
  for (std::size_t n = 2; n < Count; ++n) {
    chains[n % 2] = chains[n % 2] * square + p[Count - 1 - n];
  }
  return chains[(Count - 1) % 2] + x * chains[Count % 2];
}

/// Integral of p from 0 to x.
template <class Scalar, std::size_t Count>
Scalar integrate(const std::array<Scalar, Count>& p, Scalar x) {
  std::array<Scalar, Count> mean{};
  for (std::size_t n = 0; n < Count; ++n) {
    mean[n] = p[n] * reciprocal<Scalar>(n + 1);
  }
  return evaluate(mean, x) * x;
}

/// Integral of p q from 0 to x; q is an array or has size() and operator[] like one.
template <class Scalar, std::size_t Count, class Other>
Scalar integrate_product(const std::array<Scalar, Count>& p, const Other& q, Scalar x) {
  const std::size_t q_count = q.size();
  Scalar value = Scalar(0);
  for (std::size_t power = Count + q_count - 1; power-- > 0;) {
    const std::size_t first = power < q_count ? 0 : power - q_count + 1;
    const std::size_t last = power < Count ? power : Count - 1;
    Scalar coefficient = Scalar(0);
    for (std::size_t n = first; n <= last; ++n) {
      coefficient += p[n] * q[power - n];
    }
    value = value * x + coefficient * reciprocal<Scalar>(power + 1);
  }
  return value * x;
}

}  // namespace sonoglide::plant
