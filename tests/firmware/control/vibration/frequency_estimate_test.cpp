#include "firmware/control/vibration/frequency_estimate.hpp"

#include <gtest/gtest.h>

#include "scalars.hpp"

namespace sonoglide::control::frequency_estimate_test {
namespace {

template <class S>
class FrequencyEstimateTest : public testing::Test {};
TYPED_TEST_SUITE(FrequencyEstimateTest, Scalars);

TYPED_TEST(FrequencyEstimateTest, MovesByGradientOverSquareWhereSomethingTellsOfIt) {
  using Estimate = FrequencyEstimate<TypeParam>;
  Estimate estimate;
  estimate.restart();
  EXPECT_EQ(estimate.move(TypeParam{}, scaled<TypeParam>(0.5)), TypeParam{});
  const TypeParam move = estimate.move(scaled<TypeParam>(0.25), scaled<TypeParam>(-0.1));
  EXPECT_NEAR(numeric::to_real(move), -0.1 / (0.25 * (1 << Estimate::base)), 1e-4);
  EXPECT_EQ(estimate.frequency_parameter(), move);
}

}  // namespace
}  // namespace sonoglide::control::frequency_estimate_test
