#include "firmware/numeric/growth_matrix.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sonoglide::numeric::growth_matrix_test {
namespace {

/// exp of {{0, 1}, {-k, -d}} time, less the unit matrix: series at time / 2^20, squared.
std::array<std::array<long double, 2>, 2> growth_in_long_double(double stiffness, double damping,
                                                                double time) {
  using Matrix = std::array<std::array<long double, 2>, 2>;
  const auto times = [](const Matrix& a, const Matrix& b) {
    Matrix c{};
    for (std::size_t i = 0; i < 4; ++i) {
      c[i / 2][i % 2] = a[i / 2][0] * b[0][i % 2] + a[i / 2][1] * b[1][i % 2];
    }
    return c;
  };
  const auto k = static_cast<long double>(stiffness);
  const auto d = static_cast<long double>(damping);
  const long double s = std::ldexp(static_cast<long double>(time), -20);
  const Matrix m = {{{0.0L, s}, {-k * s, -d * s}}};
  Matrix growth = m;
  Matrix term = m;
  for (int n = 2; n < 20; ++n) {
    term = times(term, m);
    for (std::size_t i = 0; i < 4; ++i) {
      term[i / 2][i % 2] /= n;
      growth[i / 2][i % 2] += term[i / 2][i % 2];
    }
  }
  for (int i = 0; i < 20; ++i) {
    const Matrix square = times(growth, growth);
    for (std::size_t j = 0; j < 4; ++j) {
      growth[j / 2][j % 2] = 2.0L * growth[j / 2][j % 2] + square[j / 2][j % 2];
    }
  }
  return growth;
}

TEST(GrowthMatrix, IsTheExponentialLessOne) {
  for (const double k : {0.0, 1.0, 0.0467907, 1e4, -2.0}) {
    for (const double d : {0.0, 0.01, 2.0, 50.0, 1e4}) {
      for (const double t : {1e-6, 0.01, 0.5, 3.0}) {
        const auto exact = growth_in_long_double(k, d, t);
        const auto found = growth_matrix<double, 2>({{{0.0, 1.0}, {-k, -d}}}, t);
        double largest = 1.0;
        for (std::size_t i = 0; i < 4; ++i) {
          const double identity = i == 0 || i == 3 ? 1.0 : 0.0;
          largest =
              std::max(largest, std::abs(identity + static_cast<double>(exact[i / 2][i % 2])));
        }
        const double norm = t * std::max(1.0, std::abs(k) + d);
        const double doublings = std::max(0.0, std::floor(std::log2(norm)) + 2.0);
        const double bound =
            64.0 * std::numeric_limits<double>::epsilon() * (1.0 + doublings) * largest;
        for (std::size_t i = 0; i < 4; ++i) {
          const auto expected = static_cast<double>(exact[i / 2][i % 2]);
          EXPECT_NEAR(found[i / 2][i % 2], expected, bound) << k << ' ' << d << ' ' << t;
        }
      }
    }
  }
}

TEST(GrowthMatrix, KeepsTheDigitsOfASmallGrowth) {
  const double t = 1e-7;
  const auto growth = growth_matrix<double, 2>({{{0.0, 1.0}, {-4.0, 0.0}}}, t);
  EXPECT_NEAR(growth[0][0] / (-2.0 * std::sin(t) * std::sin(t)), 1.0, 1e-14);
  EXPECT_NEAR(growth[0][1] / (0.5 * std::sin(2.0 * t)), 1.0, 1e-15);
}

}  // namespace
}  // namespace sonoglide::numeric::growth_matrix_test
