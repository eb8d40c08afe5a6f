#include "firmware/numeric/gauss_legendre.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

namespace sonoglide::numeric::gauss_legendre_test {
namespace {

TEST(GaussLegendre, IntegratesEveryPolynomialOfItsDegree) {
  constexpr auto rule = gauss_legendre<24>();
  for (int power = 0; power < 48; ++power) {
    double integral = 0.0;
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      integral += rule.weight[i] * std::pow(rule.node[i], power);
    }
    EXPECT_NEAR(integral, 1.0 / (power + 1), 1e-15) << "x^" << power;
  }
}

}  // namespace
}  // namespace sonoglide::numeric::gauss_legendre_test
