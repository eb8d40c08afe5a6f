#include "firmware/control/friction/steady_mean.hpp"

#include <gtest/gtest.h>

#include "scalars.hpp"

namespace sonoglide::control::steady_mean_test {
namespace {

template <class S>
class SteadyMeanTest : public testing::Test {
 protected:
  SteadyMean<S> mean{{5, 4, numeric::from_real<numeric::Accumulator<S>>(0.25)}};

  /// @return periods until a reading is complete
  int complete(double request, double growth = 1.0, double measured = 0.2, bool followed = true) {
    for (int k = 1; k <= 100; ++k) {
      const double shown = measured + (k % 2 == 0 ? 0.01 : -0.01);
      if (mean.take({{}, scaled<S>(shown), {}, scaled<S>(0.25), scaled<S>(request), followed})) {
        return k;
      }
      request *= growth;
    }
    return 0;
  }
};
TYPED_TEST_SUITE(SteadyMeanTest, Scalars);

TYPED_TEST(SteadyMeanTest, WaitsAndAverages) {
  this->mean.begin(scaled<TypeParam>(0.3));
  EXPECT_EQ(this->complete(0.3), 9);
  EXPECT_NEAR(numeric::to_real(this->mean.measured()), 0.2, 1e-6);
  EXPECT_NEAR(numeric::to_real(this->mean.commanded()), 0.25, 1e-6);
  EXPECT_FALSE(this->mean.limited());
}

TYPED_TEST(SteadyMeanTest, TakesWhatFollowsSooner) {
  this->mean.go_on(scaled<TypeParam>(0.3));
  EXPECT_EQ(this->complete(0.3), 4);
}

TYPED_TEST(SteadyMeanTest, BeginsAnewWithAnotherRequest) {
  this->mean.begin(scaled<TypeParam>(0.3));
  EXPECT_EQ(this->complete(0.31), 9);
  EXPECT_EQ(numeric::to_real(this->mean.moved()), 0.0);
  EXPECT_EQ(this->complete(0.1, 1.02), 0) << "never stands";
  EXPECT_EQ(numeric::to_real(this->mean.moved()), 0.125);
}

TYPED_TEST(SteadyMeanTest, TakesARequestThatDrifts) {
  this->mean.begin(scaled<TypeParam>(0.3));
  EXPECT_EQ(this->complete(0.3, 1.005), 9);
  EXPECT_NEAR(numeric::to_real(this->mean.request()), 0.3 * 1.0407, 1e-4);
}

TYPED_TEST(SteadyMeanTest, TellsOfALimit) {
  this->mean.begin(scaled<TypeParam>(0.3));
  this->complete(0.3, 1.0, 0.2, false);
  EXPECT_TRUE(this->mean.limited());
}

TYPED_TEST(SteadyMeanTest, WaitsForARequestThatALimitHoldsBack) {
  this->mean.begin(scaled<TypeParam>(0.3));
  EXPECT_EQ(this->complete(0.3, 1.005, 0.2, false), 0) << "drifts behind its limit";
  EXPECT_GT(numeric::to_real(this->mean.moved()), 0.0);
}

}  // namespace
}  // namespace sonoglide::control::steady_mean_test
