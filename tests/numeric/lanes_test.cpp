/// Lanes give what their numbers give one by one.

#include "firmware/numeric/lanes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace sonoglide::numeric {
namespace {

template <class Float>
class LanesTest : public testing::Test {};
using Floats = testing::Types<double, float>;
TYPED_TEST_SUITE(LanesTest, Floats);

TYPED_TEST(LanesTest, AreLoadedInOrderAndSummed) {
  std::array<TypeParam, lane_count<TypeParam> + 1> from{};
  TypeParam sum = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    from[i] = static_cast<TypeParam>(i * i + 1);
    sum += from[i];
  }
  const Lanes<TypeParam> lanes = load(&from[1]);
  for (std::size_t i = 0; i < lane_count<TypeParam>; ++i) {
    EXPECT_EQ(lanes[i], from[i + 1]);
  }
  EXPECT_EQ(sum_of_lanes<TypeParam>(lanes), sum - from[0]);
}

TYPED_TEST(LanesTest, DecayIsExpOfMinus) {
  const bool is_double = sizeof(TypeParam) == sizeof(double);
  const double last = is_double ? 700.0 : 85.0;
  for (double z = -0.5; z < last; z += 0.0137) {
    const auto rounded = static_cast<TypeParam>(z);
    const Lanes<TypeParam> found = decay<TypeParam>(broadcast(rounded));
    const double expected = std::exp(-static_cast<double>(rounded));
    const double error = std::abs(static_cast<double>(found[0]) / expected - 1.0);
    EXPECT_EQ(found[0], found[lane_count<TypeParam> - 1]);
    EXPECT_LE(error, (is_double ? 1e-14 : 3e-7) * (1.0 + std::abs(z) / 4.0)) << z;
  }
}

}  // namespace
}  // namespace sonoglide::numeric
