/// Gauss-Legendre nodes on an arc, and tables that integrate and expand a function given at them.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/numeric/gauss_legendre.hpp"
#include "firmware/numeric/lanes.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::numeric {

namespace detail {

/// Tables in double, on [0, 1], nodes in rising order.
template <std::size_t Count>
struct GaussTables {
  numeric::GaussLegendreRule<static_cast<int>(Count)> rule =
      numeric::gauss_legendre<static_cast<int>(Count)>();

  /// Integral, from the middle of [0, 1] to node i, of the polynomial that is 1 at node j and 0 at
  /// the other nodes; exact.
  /// At compile time.
  constexpr double integral(std::size_t i, std::size_t j) const {
    double sum = 0.0;
    for (std::size_t q = 0; q < Count; ++q) {
      const double x = rule.node[i] * rule.node[q];
      double product = rule.weight[q];
      for (std::size_t m = 0; m < Count; ++m) {
        product *= m == j ? 1.0 : (x - rule.node[m]) / (rule.node[j] - rule.node[m]);
      }
      sum += product;
    }
    return rule.node[i] * sum - 0.5 * rule.weight[j];
  }

  /// What a value at node j adds to the coefficient of the Legendre polynomial of that degree.
  /// At compile time.
  constexpr double coefficient(int degree, std::size_t j) const {
    const double value = numeric::legendre(degree, 2.0 * rule.node[j] - 1.0).value;
    return (2 * degree + 1) * rule.weight[j] * value;
  }
};

}  // namespace detail

/// `Count` nodes on [0, 1] in pairs: a node of the first half and its mirror image. A function is
/// held as its values at the first half, in rising order, then at the images. The tables act on
/// sums and differences of a pair, which halves each of their sides.
template <class Float, std::size_t Count>
struct GaussNodes {
  static constexpr std::size_t pairs = Count / 2;
  static_assert(Count % (2 * numeric::lane_count<Float>) == 0, "halves fill lanes");
  template <std::size_t Size>
  struct alignas(16) Values : std::array<Float, Size> {};
  using OfPairs = Values<pairs>;

  Values<Count> node{};
  OfPairs weight{};
  /// The integral from 0 to a node is half of the whole, plus the part of the differences, plus the
  /// part of the sums (minus for the image). [j][i]: what pair j adds at node i.
  std::array<OfPairs, pairs> of_differences{};
  std::array<OfPairs, pairs> of_sums{};
  /// The two highest coefficients of a function in Legendre polynomials.
  OfPairs last_of_differences{};
  OfPairs last_but_one_of_sums{};

  /// At compile time.
  constexpr GaussNodes() {
    constexpr detail::GaussTables<Count> tables;
    constexpr int degree = static_cast<int>(Count) - 1;
    const auto rounded = [](double x) { return numeric::from_real<Float>(x); };
    for (std::size_t i = 0; i < pairs; ++i) {
      node[i] = rounded(tables.rule.node[i]);
      node[pairs + i] = rounded(tables.rule.node[Count - 1 - i]);
      weight[i] = rounded(tables.rule.weight[i]);
      last_of_differences[i] = rounded(tables.coefficient(degree, i));
      last_but_one_of_sums[i] = rounded(tables.coefficient(degree - 1, i));
      for (std::size_t j = 0; j < pairs; ++j) {
        const double own = tables.integral(i, j);
        const double image = tables.integral(i, Count - 1 - j);
        of_differences[j][i] = rounded(0.5 * (own - image));
        of_sums[j][i] = rounded(0.5 * (own + image));
      }
    }
  }
};

template <class Float, std::size_t Count>
inline constexpr GaussNodes<Float, Count> gauss_nodes{};

}  // namespace sonoglide::numeric
