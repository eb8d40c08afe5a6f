/// The first sign change of the sliding velocity inside a step: certified, and mostly quick.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "firmware/numeric/first_root.hpp"
#include "firmware/numeric/power_series.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::plant {

namespace detail {

/// A cubic by its Bernstein coefficients on [0, 1]: it lies between the least and the greatest.
template <class Scalar>
struct Cubic {
  std::array<Scalar, 4> control;

  bool stays_above(Scalar margin) const {
    return numeric::min(numeric::min(control[0], control[1]),
                        numeric::min(control[2], control[3])) > margin;
  }
  /// The same of the cubic over x where it begins with zero: there it is a parabola.
  bool rises_above(Scalar margin) const {
    const Scalar first = Scalar(3) * control[1];
    const Scalar second = control[2] + numeric::half(control[2]);
    return numeric::min(numeric::min(first, second), control[3]) > margin;
  }
  /// Falls throughout, by more than the margin in each third.
  bool falls(Scalar margin) const {
    const Scalar first = control[0] - control[1];
    const Scalar second = control[1] - control[2];
    const Scalar third = control[2] - control[3];
    return numeric::min(numeric::min(first, second), third) > margin;
  }
  /// Near its root, where it falls from above zero to below: from the chord, one step of Halley's.
  Scalar root() const {
    const Scalar b = Scalar(3) * (control[1] - control[0]);
    const Scalar c = Scalar(3) * (control[2] - control[1]) - b;
    const Scalar d = control[3] - control[0] - b - c;
    const Scalar chord = control[0] / (control[0] - control[3]);
    const Scalar value = control[0] + chord * (b + chord * (c + chord * d));
    const Scalar inverse_slope =
        Scalar(1) / (b + chord * (numeric::twice(c) + Scalar(3) * chord * d));
    const Scalar newton = value * inverse_slope;
    const Scalar bend = (c + Scalar(3) * chord * d) * inverse_slope;
    return chord - newton * (Scalar(1) + newton * bend);
  }
};

/// A root of p from a guess that is a few per cent of `length` off; NaN if it is not found. Each
/// pass takes the error to its fourth power: the inverse series of p about the guess, up to the
/// third derivative. The last one must be short, and p nearly straight over it.
template <class Scalar, std::size_t Count>
Scalar polished_root(const std::array<Scalar, Count>& p, Scalar guess, Scalar length) {
  constexpr bool is_short = std::numeric_limits<Scalar>::digits <= 24;
  constexpr Scalar close = numeric::from_real<Scalar>(is_short ? 2e-2 : 2e-4);
  constexpr int most_passes = 8;
  const auto slope = numeric::derivative<1>(p);
  const auto bend = numeric::derivative<2>(p);
  const auto twist = numeric::derivative<3>(p);
  Scalar root = guess;
  for (int pass = 0; pass < most_passes; ++pass) {
    const Scalar inverse_slope = Scalar(1) / numeric::evaluate(slope, root);
    const Scalar newton = inverse_slope * numeric::evaluate(p, root);
    const Scalar b = newton * inverse_slope * numeric::evaluate(bend, root);
    const Scalar c = newton * newton * inverse_slope * numeric::evaluate(twist, root);
    root -= newton * (Scalar(1) + (b + (numeric::twice(b * b) - c)));
    if (numeric::abs(newton) <= close * length && numeric::abs(b) <= close &&
        numeric::abs(c) <= close) {
      return root;
    }
  }
  return std::numeric_limits<Scalar>::quiet_NaN();
}

/// Bound of |p - q| on [0, end], end <= 1: q is the cubic that has p's value and first two
/// derivatives at 0 and its value at end. Of each power u^n of p it leaves u^n - u^3, which is
/// below 1 - 3/n on [0, 1]; rounding adds some epsilon of every term.
template <class Scalar, std::size_t Count>
[[gnu::always_inline]] inline Scalar cubic_remainder(const std::array<Scalar, Count>& p,
                                                     Scalar end) {
  constexpr double rounding = 16.0 * static_cast<double>(std::numeric_limits<Scalar>::epsilon());
  std::array<Scalar, 2> sum = {};
  for (std::size_t n = 4; n < Count; ++n) {
    const double left = 1.0 - 3.0 / static_cast<double>(n) + rounding;
    sum[n % 2] += numeric::from_real<Scalar>(left) * numeric::abs(p[n]);
  }
  const Scalar low = numeric::abs(p[0]) + numeric::abs(p[1]) + numeric::abs(p[2]);
  const Scalar square = end * end;
  return square * square * (sum[0] + sum[1]) +
         numeric::from_real<Scalar>(rounding) * (low + numeric::abs(p[3]));
}

/// The bound for the cubic between two points with values and slopes: length^4 / 384 times the sum
/// of the moduli of p''''.
template <class Scalar, std::size_t Count>
Scalar hermite_remainder(const std::array<Scalar, Count>& p, Scalar end, Scalar length) {
  constexpr double rounding = 16.0 * static_cast<double>(std::numeric_limits<Scalar>::epsilon());
  std::array<Scalar, Count> bend{};
  for (std::size_t n = 4; n < Count; ++n) {
    const double derived = static_cast<double>(n * (n - 1) * (n - 2) * (n - 3));
    bend[n - 4] = numeric::from_real<Scalar>(derived / 384.0) * numeric::abs(p[n]);
  }
  std::array<Scalar, Count> moduli{};
  for (std::size_t n = 0; n < Count; ++n) {
    moduli[n] = numeric::abs(p[n]);
  }
  const Scalar square = length * length;
  return square * square * numeric::evaluate(bend, end) +
         numeric::from_real<Scalar>(rounding) * numeric::evaluate(moduli, end);
}

}  // namespace detail

/// True only if direction p(x) is positive on (0, end], end <= 1, where it has at 0 a zero of the
/// given order and is positive beyond. False says nothing.
template <class Scalar, std::size_t Count>
[[gnu::always_inline]] inline bool certainly_keeps_sign(const std::array<Scalar, Count>& p,
                                                        Scalar direction, std::size_t zero_order,
                                                        Scalar end, Scalar end_value) {
  const Scalar third = numeric::from_real<Scalar>(1.0 / 3.0);
  const Scalar rise = third * end * p[1];
  const Scalar bend = third * (end * end) * p[2];
  const detail::Cubic<Scalar> cubic = {{direction * p[0], direction * (p[0] + rise),
                                        direction * (p[0] + numeric::twice(rise) + bend),
                                        direction * end_value}};
  const Scalar margin = detail::cubic_remainder(p, end);
  // (u^3 - u^n) / u is below 3 (u^3 - u^n) at its greatest, for n >= 4.
  return zero_order == 0 ? cubic.stays_above(margin)
                         : zero_order == 1 && cubic.rises_above(Scalar(3) * margin);
}

/// The first x in (0, end) at which p changes sign, or `end` if there is none; direction p(x) has
/// at 0 a zero of the given order and is positive beyond.
///
/// Cubics on either half, with bounds of what they miss, tell most cases: no zero, or one in a half
/// in which p falls throughout. The rest is searched for by first_root.
template <class Scalar, std::size_t Count>
[[gnu::noinline]] Scalar first_reversal(const std::array<Scalar, Count>& p, Scalar direction,
                                        std::size_t zero_order, Scalar end) {
  if (zero_order < 2) {
    const auto slopes = numeric::derivative<1>(p);
    const Scalar middle = numeric::half(end);
    const Scalar third = middle * direction * numeric::from_real<Scalar>(1.0 / 3.0);
    const Scalar first = direction * p[0];
    const Scalar half_way = direction * numeric::evaluate(p, middle);
    const Scalar last = direction * numeric::evaluate(p, end);
    const Scalar bend = third * numeric::evaluate(slopes, middle);
    const detail::Cubic<Scalar> left = {{first, first + third * p[1], half_way - bend, half_way}};
    const detail::Cubic<Scalar> right = {
        {half_way, half_way + bend, last - third * numeric::evaluate(slopes, end), last}};
    const Scalar margin = detail::hermite_remainder(p, end, middle);
    const bool left_is_free =
        zero_order == 0 ? left.stays_above(margin) : left.rises_above(Scalar(3) * margin);
    Scalar root = end;
    if (left_is_free && right.stays_above(margin)) {
      return end;
    }
    if (left_is_free && last < Scalar(0) && right.falls(numeric::twice(margin))) {
      root = detail::polished_root(p, middle + middle * right.root(), middle);
      if (middle < root && root < end) {
        return root;
      }
    }
    if (zero_order == 0 && half_way < Scalar(0) && left.falls(numeric::twice(margin))) {
      root = detail::polished_root(p, middle * left.root(), middle);
      if (Scalar(0) < root && root < middle) {
        return root;
      }
    }
  }
  return numeric::first_root(numeric::without_zero(p, direction, zero_order), end);
}

}  // namespace sonoglide::plant
