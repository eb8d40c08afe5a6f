#include "firmware/numeric/arithmetic_geometric_mean.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace sonoglide::numeric::arithmetic_geometric_mean_test {
namespace {

template <class Float>
class ArithmeticGeometricMean : public testing::Test {};
using Floats = testing::Types<double, float>;
TYPED_TEST_SUITE(ArithmeticGeometricMean, Floats);

TYPED_TEST(ArithmeticGeometricMean, IsThePublishedOne) {
  struct Published {
    double a;
    double b;
    double mean;
  };
  // The first is Gauss's, of 1799; its inverse is his constant.
  for (const Published& published :
       {Published{1.0, 1.41421356237309504880, 1.19814023473559220744},
        Published{24.0, 6.0, 13.4581714817256154208}, Published{5.0, 5.0, 5.0}}) {
    const auto expected = static_cast<TypeParam>(published.mean);
    const TypeParam allowed = 4 * expected * std::numeric_limits<TypeParam>::epsilon();
    const auto a = static_cast<TypeParam>(published.a);
    const auto b = static_cast<TypeParam>(published.b);
    EXPECT_NEAR(arithmetic_geometric_mean(a, b), expected, allowed);
    EXPECT_NEAR(arithmetic_geometric_mean(b, a), expected, allowed);
  }
}

// a/b = 4000: the series of the elliptic integral near its singularity, M = pi a / (2 log(4 a/b)) within (b/a)^2.
TYPED_TEST(ArithmeticGeometricMean, OfNumbersFarApartHasItsLogarithm) {
  const auto mean = arithmetic_geometric_mean(TypeParam(1), TypeParam(1.0 / 4000.0));
  EXPECT_NEAR(mean, 3.14159265358979323846 / (2.0 * 9.68034400122192), 1e-6);
}

}  // namespace
}  // namespace sonoglide::numeric::arithmetic_geometric_mean_test
