#include "firmware/numeric/gauss_nodes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

namespace sonoglide::numeric::gauss_nodes_test {
namespace {

TEST(GaussNodes, IntegrateAPolynomialToEachNode) {
  constexpr auto& gauss = gauss_nodes<double, 8>;
  // f = x^7: its integral is x^8 / 8.
  const auto f = [&](std::size_t i) { return std::pow(gauss.node[i], 7); };
  for (std::size_t i = 0; i < 4; ++i) {
    double half_of_whole = 0.0;
    double alike = 0.0;
    double mirrored = 0.0;
    for (std::size_t j = 0; j < 4; ++j) {
      half_of_whole += 0.5 * gauss.weight[j] * (f(j) + f(4 + j));
      alike += gauss.of_differences[j][i] * (f(j) - f(4 + j));
      mirrored += gauss.of_sums[j][i] * (f(j) + f(4 + j));
    }
    EXPECT_NEAR(half_of_whole + alike + mirrored, std::pow(gauss.node[i], 8) / 8.0, 1e-15);
    EXPECT_NEAR(half_of_whole + alike - mirrored, std::pow(gauss.node[4 + i], 8) / 8.0, 1e-15);
  }
}

TEST(GaussNodes, KnowTheHighestLegendreCoefficients) {
  constexpr auto& gauss = gauss_nodes<double, 4>;
  // On [-1, 1]: P_3 = (5 x^3 - 3 x) / 2, P_2 = (3 x^2 - 1) / 2.
  double last = 0.0;
  double last_but_one = 0.0;
  const auto f = [&](std::size_t i) {
    const double x = 2.0 * gauss.node[i] - 1.0;
    return 1.25 * (5.0 * x * x * x - 3.0 * x) / 2.0 - 0.75 * (3.0 * x * x - 1.0) / 2.0 + x + 2.0;
  };
  for (std::size_t j = 0; j < 2; ++j) {
    last += gauss.last_of_differences[j] * (f(j) - f(2 + j));
    last_but_one += gauss.last_but_one_of_sums[j] * (f(j) + f(2 + j));
  }
  EXPECT_NEAR(last, 1.25, 1e-14);
  EXPECT_NEAR(last_but_one, -0.75, 1e-14);
}

}  // namespace
}  // namespace sonoglide::numeric::gauss_nodes_test
