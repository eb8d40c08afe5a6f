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

TYPED_TEST(LanesTest, ShowTheirSigns) {
  Lanes<TypeParam> lanes = broadcast(TypeParam(2));
  lanes[1] = TypeParam(-3);
  const LaneBits<TypeParam> bits = is_negative<TypeParam>(lanes);
  for (std::size_t i = 0; i < lane_count<TypeParam>; ++i) {
    EXPECT_EQ(bits[i], i == 1 ? 1U : 0U);
  }
}

TYPED_TEST(LanesTest, ModerateDecayIsExpOfMinus) {
  const double allowed = sizeof(TypeParam) == sizeof(double) ? 1e-13 : 5e-6;
  for (double z = -0.5; z <= 6.0; z += 0.00137) {
    const auto rounded = static_cast<TypeParam>(z);
    const Lanes<TypeParam> found = moderate_decay<TypeParam>(broadcast(rounded));
    EXPECT_EQ(found[0], found[lane_count<TypeParam> - 1]);
    EXPECT_NEAR(static_cast<double>(found[0]), std::exp(-static_cast<double>(rounded)), allowed)
        << z;
  }
}

}  // namespace
}  // namespace sonoglide::numeric
