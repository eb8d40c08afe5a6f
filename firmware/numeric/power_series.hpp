/// Polynomials given by their coefficients, lowest power first.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/numeric/scalar.hpp"

namespace sonoglide::numeric {

namespace detail {

inline constexpr std::size_t reciprocal_count = 64;

/// At compile time.
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

/// x^N.
template <std::size_t N, class Scalar>
constexpr Scalar power(Scalar x) {
  if constexpr (N == 0) {
    return Scalar(1);
  } else if constexpr (N % 2 == 1) {
    return x * power<N - 1>(x);
  } else {
    return power<N / 2>(x * x);
  }
}

/// Sum of p[n] x^(n - First), n >= First, in four independent chains, one for each power modulo 4.
/// Always inlined: a call for each polynomial cost the solver a fifth of its time.
template <std::size_t First, class Scalar, std::size_t Count>
[[gnu::always_inline]] inline Scalar evaluate_from(const std::array<Scalar, Count>& p, Scalar x) {
  static_assert(Count > First, "nothing to sum");
  constexpr std::size_t highest = Count > First + 4 ? Count - 4 : First;
  const Scalar square = x * x;
  const Scalar fourth = square * square;
  std::array<Scalar, 4> chain = {};
  for (std::size_t k = highest; k < Count; ++k) {
    chain[(k - First) % 4] = p[k];
  }
  for (std::size_t k = highest; k-- > First;) {
    chain[(k - First) % 4] = chain[(k - First) % 4] * fourth + p[k];
  }
  return (chain[0] + x * chain[1]) + square * (chain[2] + x * chain[3]);
}

/// p(x).
template <class Scalar, std::size_t Count>
Scalar evaluate(const std::array<Scalar, Count>& p, Scalar x) {
  return evaluate_from<0>(p, x);
}

/// Coefficients of the derivative of p of the given degree, over the factorial of the degree.
template <std::size_t Degree, class Scalar, std::size_t Count>
std::array<Scalar, Count - Degree> derivative(const std::array<Scalar, Count>& p) {
  std::array<Scalar, Count - Degree> result{};
  for (std::size_t n = Degree; n < Count; ++n) {
    std::size_t binomial = 1;
    for (std::size_t k = 0; k < Degree; ++k) {
      binomial = binomial * (n - k) / (k + 1);
    }
    result[n - Degree] = static_cast<Scalar>(binomial) * p[n];
  }
  return result;
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

/// Integral of x p from 0 to x.
template <class Scalar, std::size_t Count>
Scalar first_moment(const std::array<Scalar, Count>& p, Scalar x) {
  std::array<Scalar, Count> mean{};
  for (std::size_t n = 0; n < Count; ++n) {
    mean[n] = p[n] * reciprocal<Scalar>(n + 2);
  }
  return evaluate(mean, x) * x * x;
}

}  // namespace sonoglide::numeric
