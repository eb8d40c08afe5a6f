/// The first sign change of the sliding velocity inside a step, found with certainty.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "firmware/numeric/first_root.hpp"
#include "firmware/numeric/power_series.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::plant {

namespace detail {

/// A cubic by its Bernstein coefficients on [0, 1]; its values lie between the smallest and the
/// largest coefficient.
template <class Scalar>
struct Cubic {
  std::array<Scalar, 4> control;

  bool stays_above(Scalar margin) const {
    return numeric::min(numeric::min(control[0], control[1]),
                        numeric::min(control[2], control[3])) > margin;
  }
  /// For a cubic that begins with zero: cubic / x, a parabola, stays above the margin.
  bool rises_above(Scalar margin) const {
    const Scalar first = Scalar(3) * control[1];
    const Scalar second = control[2] + numeric::half(control[2]);
    return numeric::min(numeric::min(first, second), control[3]) > margin;
  }
  /// The cubic falls throughout, by more than the margin in each third.
  bool falls(Scalar margin) const {
    const Scalar first = control[0] - control[1];
    const Scalar second = control[1] - control[2];
    const Scalar third = control[2] - control[3];
    return numeric::min(numeric::min(first, second), third) > margin;
  }
  /// Near the root of a cubic that falls through zero: one step of Halley's method from the chord.
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

/// Where the polishing of a root has come to.
template <class Scalar>
struct PolishedRoot {
  Scalar place;
  bool found;  ///< if false, `place` means nothing

  bool lies_between(Scalar low, Scalar high) const { return found && low < place && place < high; }
};

/// A root of p from a guess that is a few per cent of `length` off. Each pass uses the inverse
/// series of p about the guess up to the third derivative, which takes the error to its fourth
/// power. The root is found once a pass is short and p is nearly straight over it.
template <class Scalar, std::size_t Count>
PolishedRoot<Scalar> polished_root(const std::array<Scalar, Count>& p, Scalar guess,
                                   Scalar length) {
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
      return {root, true};
    }
  }
  return {root, false};
}

/// Bound of |p - q| on [0, end], end <= 1. q is the cubic that has p's value and first two
/// derivatives at 0 and p's value at end. For each power u^n of p, |u^n - u^3| remains, which is
/// below 1 - 3/n on [0, 1]. Rounding adds some epsilon of every term.
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

/// The same bound for the cubic that has p's values and slopes at two points: length^4 / 384 times
/// the sum of the moduli of the terms of p''''.
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

/// True only if direction p(x) is positive on (0, end], end <= 1; false proves nothing. At 0 it
/// must have a zero of the given order and be positive just beyond.
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

/// The first x in (0, end) at which p changes sign, or `end` if there is none. At 0 direction p(x)
/// must have a zero of the given order and be positive just beyond.
///
/// Cubics on the two halves, with bounds of their errors, settle most cases: no zero, or one zero
/// in a half in which p falls throughout. first_root settles the rest.
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
    if (left_is_free && right.stays_above(margin)) {
      return end;
    }
    if (left_is_free && last < Scalar(0) && right.falls(numeric::twice(margin))) {
      const auto root = detail::polished_root(p, middle + middle * right.root(), middle);
      if (root.lies_between(middle, end)) {
        return root.place;
      }
    }
    if (zero_order == 0 && half_way < Scalar(0) && left.falls(numeric::twice(margin))) {
      const auto root = detail::polished_root(p, middle * left.root(), middle);
      if (root.lies_between(Scalar(0), middle)) {
        return root.place;
      }
    }
  }
  return numeric::first_root(numeric::without_zero(p, direction, zero_order), end);
}

}  // namespace sonoglide::plant
