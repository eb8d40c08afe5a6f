#include "firmware/control/vibration/frequency_estimate.hpp"

#include <gtest/gtest.h>

#include "scalars.hpp"

namespace sonoglide::control::frequency_estimate_test {
namespace {

template <class S>
class FrequencyEstimateTest : public testing::Test {};
TYPED_TEST_SUITE(FrequencyEstimateTest, Scalars);

TYPED_TEST(FrequencyEstimateTest, StaysWhereNothingTellsOfIt) {
  FrequencyEstimate<TypeParam> estimate;
  estimate.restart();
  EXPECT_EQ(estimate.move(TypeParam{}, scaled<TypeParam>(0.5)), TypeParam{});
  EXPECT_NE(estimate.move(scaled<TypeParam>(0.25), scaled<TypeParam>(0.001)), TypeParam{});
}

}  // namespace
}  // namespace sonoglide::control::frequency_estimate_test
