#include "firmware/control/friction/friction_drift.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scalars.hpp"

namespace sonoglide::control::friction_drift_test {
namespace {

template <class S>
class FrictionDriftTest : public testing::Test {
 protected:
  double resolution = control::resolution<S>();
  FrictionDrift<S> drift;

  /// Moves by the error of a belief. @return the belief's
  double follow(double truth, double belief) {
    return belief + numeric::to_real(drift.follow(scaled<S>(truth - belief)));
  }
};
TYPED_TEST_SUITE(FrictionDriftTest, Scalars);

TYPED_TEST(FrictionDriftTest, FollowsARampWithoutALag) {
  for (const double each : {0.0002, 0.003, -0.007}) {
    this->drift.begin(TypeParam{});
    double belief = 0.0;
    for (int k = 1; k <= 20; ++k) {
      belief = this->follow(k * each, belief);
      if (k > 1) {
        EXPECT_NEAR(belief, (k + 1) * each, 40.0 * this->resolution) << "ahead by one reading";
      }
    }
    EXPECT_NEAR(numeric::to_real(this->drift.variance()), 4.0 * each * each,
                1e-6 * each * each + 40.0 * this->resolution);
  }
}

TYPED_TEST(FrictionDriftTest, DoesNotContinueAJump) {
  this->drift.begin(TypeParam{});
  EXPECT_NEAR(this->follow(0.02, 0.0), 0.02, 4.0 * this->resolution);
  EXPECT_NEAR(this->follow(0.02, 0.02), 0.02, 4.0 * this->resolution);
}

TYPED_TEST(FrictionDriftTest, IsAheadByAHalfOfAHundredAndTwentyEighthAtMost) {
  this->drift.begin(TypeParam{});
  double belief = this->follow(0.02, 0.0);
  belief = this->follow(0.04, belief);
  EXPECT_NEAR(belief, 0.04 + 1.0 / 128.0, 4.0 * this->resolution);
}

TYPED_TEST(FrictionDriftTest, StopsWhereTheFrictionStops) {
  this->drift.begin(TypeParam{});
  double belief = this->follow(0.003, 0.0);
  belief = this->follow(0.006, belief);
  belief = this->follow(0.006, belief);
  EXPECT_NEAR(belief, 0.006, 4.0 * this->resolution);
  EXPECT_FALSE(this->drift.moves(TypeParam{}, scaled<TypeParam>(0.0005)));
}

TYPED_TEST(FrictionDriftTest, GivesLittleForWhatMayBeNoise) {
  const double noise = 0.001;
  for (const double shown : {0.0005, 0.002, -0.01}) {
    for (const double force_slope : {0.5, 0.6, 0.9}) {
      const double square = shown * shown;
      const double wanted = shown / (2.0 * force_slope) * square / (square + 4.0 * noise * noise);
      EXPECT_NEAR(
          numeric::to_real(FrictionDrift<TypeParam>::error(
              scaled<TypeParam>(shown), scaled<TypeParam>(noise), scaled<TypeParam>(force_slope))),
          wanted, 0.002 * std::abs(wanted));
    }
    EXPECT_EQ(this->drift.moves(scaled<TypeParam>(shown), scaled<TypeParam>(noise)),
              std::abs(shown) > noise);
  }
}

TYPED_TEST(FrictionDriftTest, ShowsWhatIsBeyondTheBase) {
  this->drift.begin(scaled<TypeParam>(0.01));
  EXPECT_NEAR(numeric::to_real(this->drift.shown(scaled<TypeParam>(0.03))), 0.02,
              4.0 * this->resolution);
}

}  // namespace
}  // namespace sonoglide::control::friction_drift_test
