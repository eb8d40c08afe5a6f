/// The first root of a polynomial, with certainty: no root and no pair of roots is passed over.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/power_series.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::numeric {

namespace detail {

/// A lower bound of p'' on [0, end]: the coefficients of t^3 and above count only where negative.
template <class Scalar, std::size_t Count>
Scalar lowest_curvature(const std::array<Scalar, Count>& p, Scalar end) {
  Scalar bound = Scalar(0);
  for (std::size_t n = Count; n-- > 3;) {
    bound = bound * end + static_cast<Scalar>(n * (n - 1)) * numeric::min(p[n], Scalar(0));
  }
  return Scalar(2) * p[2] + bound * end;
}

/// A lower bound of the smallest positive root of value + slope t + curvature t^2 / 2, value > 0;
/// `none` if there is no root before it. The bound is close to the root if slope^2 > 2 value
/// |curvature|.
template <class Scalar>
Scalar parabola_root(Scalar value, Scalar slope, Scalar curvature, Scalar none) {
  const bool positive_at_end = value + none * (slope + numeric::half(none * curvature)) > Scalar(0);
  if (positive_at_end && (curvature <= Scalar(0) || slope >= Scalar(0))) {
    return none;
  }
  const Scalar square = slope * slope;
  const Scalar bend = Scalar(2) * value * curvature;
  if (bend > square) {
    return none;
  }
  // Neither form subtracts what is nearly equal.
  if (slope >= Scalar(0)) {
    return numeric::min(none, (slope + numeric::sqrt(square - bend)) / -curvature);
  }
  // sqrt(1 - q) <= 1 - q / 2 saves the square root where the answer is nearly a Newton step.
  const Scalar root = numeric::abs(bend) < square ? numeric::half(bend / slope) - slope
                                                  : numeric::sqrt(square - bend);
  return numeric::min(none, Scalar(2) * value / (root - slope));
}

/// A search for the first root of a polynomial in t / unit.
template <class Scalar, std::size_t Count>
struct RootSearch {
  std::array<Scalar, Count> polynomial;
  Scalar end;
  Scalar unit;
};

/// The search for a root of p before `end`, in units in which no square of its numbers vanishes or
/// overflows. Most polynomials stay as they are; the others are written in units of `end` and of
/// the largest term.
template <class Scalar, std::size_t Count>
RootSearch<Scalar, Count> of_moderate_size(const std::array<Scalar, Count>& p, Scalar end) {
  using Limits = std::numeric_limits<Scalar>;
  const Scalar small = numeric::sqrt(Limits::min()) / Limits::epsilon();
  Scalar largest = Limits::min();
  for (const Scalar coefficient : p) {
    largest = numeric::max(largest, numeric::abs(coefficient));
  }
  if (p[0] >= small && largest <= Scalar(1) / small) {
    return {p, end, Scalar(1)};
  }
  // One factor at a time: the powers of a short end would vanish, and so would p[0] over a term
  // that only the end makes small.
  RootSearch<Scalar, Count> search = {p, Scalar(1), end};
  Scalar largest_term = Limits::min();
  for (std::size_t n = 0; n < Count; ++n) {
    for (std::size_t factor = 0; factor < n; ++factor) {
      search.polynomial[n] *= end;
    }
    largest_term = numeric::max(largest_term, numeric::abs(search.polynomial[n]));
  }
  for (Scalar& term : search.polynomial) {
    term /= largest_term;
  }
  return search;
}

/// A bound of the rounding error of p(t), t >= 0.
template <class Scalar, std::size_t Count>
Scalar rounding_bound(const std::array<Scalar, Count>& p, Scalar t) {
  Scalar sum = Scalar(0);
  for (std::size_t n = Count; n-- > 0;) {
    sum = sum * t + numeric::abs(p[n]);
  }
  return Scalar(4) * std::numeric_limits<Scalar>::epsilon() * sum;
}

}  // namespace detail

/// direction p(t) / t^zero_order, for a p whose terms below that order vanish.
template <class Scalar, std::size_t Count>
std::array<Scalar, Count> without_zero(const std::array<Scalar, Count>& p, Scalar direction,
                                       std::size_t zero_order) {
  std::array<Scalar, Count> quotient{};
  for (std::size_t n = zero_order; n < Count; ++n) {
    quotient[n - zero_order] = direction * p[n];
  }
  return quotient;
}

/// The first t in (0, none) with p(t) = 0; `none` if there is no root. Requires p(0) > 0.
///
/// Each step moves to the root of a parabola that lies below p up to the end of a window: it has
/// the value and the slope of p, and the lowest curvature of p in the window. This root cannot lie
/// beyond a root of p. The steps shrink quadratically towards a simple root. Towards a double root
/// they shrink by a constant factor, until p is within its rounding error of zero: that counts as a
/// root. Where the curvature keeps the steps short, the window narrows and the curvature bound
/// improves.
template <class Scalar, std::size_t Count>
[[gnu::noinline]] Scalar first_root(const std::array<Scalar, Count>& polynomial, Scalar none) {
  static_assert(Count >= 4, "the curvature bound needs a cubic");
  const auto [p, end, unit] = detail::of_moderate_size(polynomial, none);
  const Scalar quarter = numeric::from_real<Scalar>(0.25);
  Scalar window = end;
  Scalar curvature = detail::lowest_curvature(p, window);
  Scalar t = Scalar(0);
  Scalar value = p[0];
  Scalar slope = p[1];
  for (;;) {
    const Scalar rest = window - t;
    const Scalar step = detail::parabola_root(value, slope, curvature, rest);
    if (step >= rest) {
      if (window >= end) {
        return none;
      }
      t = window;
      window = numeric::min(end, numeric::twice(window));
      curvature = detail::lowest_curvature(p, window);
    } else {
      if (t + step == t) {
        return unit * t;
      }
      t += step;
      if (step < quarter * rest) {
        window = numeric::min(window, t + numeric::twice(t));
        curvature = detail::lowest_curvature(p, window);
      }
    }
    value = p[Count - 1];
    slope = Scalar(0);
    for (std::size_t n = Count - 1; n-- > 0;) {
      slope = slope * t + value;
      value = value * t + p[n];
    }
    // Not <=: a value that is no number ends the search too.
    if (!(value > detail::rounding_bound(p, t))) {
      return unit * t;
    }
  }
}

}  // namespace sonoglide::numeric
