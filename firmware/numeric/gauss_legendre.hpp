/// Gauss–Legendre quadrature rules, computed at compile time.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/numeric/lanes.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::numeric {

/// Nodes and weights on [0, 1].
template <int Count>
struct GaussLegendreRule {
  std::array<double, Count> node{};
  std::array<double, Count> weight{};
};

/// A Legendre polynomial and its derivative at one point.
struct Legendre {
  double value;
  double slope;
};

/// Legendre polynomial of a degree >= 1 at |x| < 1, by the three-term recurrence. Error: a few
/// roundings per degree.
/// At compile time.
constexpr Legendre legendre(int degree, double x) {
  double previous = 1.0;
  double value = x;
  for (int n = 2; n <= degree; ++n) {
    const double next = ((2 * n - 1) * x * value - (n - 1) * previous) / n;
    previous = value;
    value = next;
  }
  return {value, degree * (x * value - previous) / (x * x - 1.0)};
}

namespace gauss_legendre_detail {

/// Largest root of P_Count below `start` that is not among the first `already` found. Those are
/// divided out, so that Newton's method descends monotonically from the right.
/// At compile time.
template <int Count>
constexpr double next_root(const std::array<double, Count>& found, int already, double start) {
  double x = start;
  for (int iteration = 0; iteration < 200; ++iteration) {
    const Legendre p = legendre(Count, x);
    double deflation = 0.0;
    for (int i = 0; i < already; ++i) {
      deflation += 1.0 / (x - found[static_cast<std::size_t>(i)]);
    }
    const double step = p.value / (p.slope - p.value * deflation);
    x -= step;
    if (step < 1e-17 && step > -1e-17) {
      break;
    }
  }
  return x;
}

}  // namespace gauss_legendre_detail

/// The rule of `Count` nodes, exact for polynomials of degree 2·Count − 1.
/// Nodes and weights are within 1e-15 (tested against moments).
/// At compile time.
template <int Count>
constexpr GaussLegendreRule<Count> gauss_legendre() {
  std::array<double, Count> root{};
  GaussLegendreRule<Count> rule;
  double start = 0.99999;
  for (int i = 0; i < Count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    root[at] = gauss_legendre_detail::next_root<Count>(root, i, start);
    start = root[at] - 1e-6;
    const double slope = legendre(Count, root[at]).slope;
    rule.node[at] = 0.5 * (1.0 - root[at]);
    rule.weight[at] = 1.0 / ((1.0 - root[at] * root[at]) * slope * slope);
  }
  return rule;
}

// A Gauss-Legendre rule as whole lanes.

/// `Count` nodes on [0, 1] in rising order, and their weights; whole lanes of them.
template <class Float, std::size_t Count>
struct GaussRule {
  static_assert(Count % numeric::lane_count<Float> == 0, "nodes fill lanes");
  static constexpr std::size_t vectors = Count / numeric::lane_count<Float>;

  alignas(16) std::array<Float, Count> node{};
  alignas(16) std::array<Float, Count> weight{};

  /// At compile time.
  constexpr GaussRule() {
    const auto rule = numeric::gauss_legendre<static_cast<int>(Count)>();
    for (std::size_t i = 0; i < Count; ++i) {
      node[i] = numeric::from_real<Float>(rule.node[i]);
      weight[i] = numeric::from_real<Float>(rule.weight[i]);
    }
  }
};

template <class Float, std::size_t Count>
inline constexpr GaussRule<Float, Count> gauss_rule{};

}  // namespace sonoglide::numeric
