/// Lanes give what their numbers give one by one.

#include "firmware/numeric/lanes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "firmware/numeric/lane_group.hpp"

namespace sonoglide::numeric::lanes_test {
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

TYPED_TEST(LanesTest, ModerateDecayGoesOnToNothing) {
  const double allowed = sizeof(TypeParam) == sizeof(double) ? 1e-9 : 5e-6;
  const auto longest = static_cast<double>(longest_decay<TypeParam>);
  EXPECT_LT(std::exp(-longest), allowed);
  for (double z = 6.0; z <= longest; z += 0.0173) {
    const auto rounded = static_cast<TypeParam>(z);
    const Lanes<TypeParam> found = moderate_decay<TypeParam>(broadcast(rounded));
    EXPECT_NEAR(static_cast<double>(found[0]), std::exp(-static_cast<double>(rounded)), allowed)
        << z;
  }
}

TYPED_TEST(LanesTest, AGroupGivesWhatEachOfItsVectorsGives) {
  constexpr std::size_t width = lane_count<TypeParam>;
  std::array<TypeParam, 3 * width> from{};
  for (std::size_t i = 0; i < from.size(); ++i) {
    from[i] = static_cast<TypeParam>(0.37) * static_cast<TypeParam>(i + 1);
  }
  const auto three = TypeParam(3);
  const auto x = load_group<3>(from.data());
  const auto limited = at_most(TypeParam(1), x);
  const auto mixed = three * x * x + (three - x) * three - three;
  const auto decay = moderate_decay<TypeParam>(x);
  Lanes<TypeParam> sum{};
  for (std::size_t v = 0; v < 3; ++v) {
    const Lanes<TypeParam> alone = load(&from[v * width]);
    const Lanes<TypeParam> expected = three * alone * alone + (three - alone) * three - three;
    const Lanes<TypeParam> expected_decay = moderate_decay<TypeParam>(alone);
    sum += alone;
    for (std::size_t lane = 0; lane < width; ++lane) {
      EXPECT_EQ(x.part[v][lane], alone[lane]);
      EXPECT_EQ(mixed.part[v][lane], expected[lane]);
      EXPECT_EQ(decay.part[v][lane], expected_decay[lane]);
      EXPECT_EQ(limited.part[v][lane], std::fmin(alone[lane], TypeParam(1)));
    }
  }
  EXPECT_EQ(sum_of_lanes(x), sum_of_lanes<TypeParam>(sum));
}

TYPED_TEST(LanesTest, WhatIsNoNumberIsLimited) {
  const auto none = broadcast(std::numeric_limits<TypeParam>::quiet_NaN());
  EXPECT_EQ(at_most<TypeParam>(TypeParam(2), none)[0], TypeParam(2));
}

}  // namespace
}  // namespace sonoglide::numeric::lanes_test
