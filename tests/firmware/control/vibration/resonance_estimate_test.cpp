/// What a wrong reading leaves behind in the estimate of the natural frequency.
#include "firmware/control/vibration/resonance_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scalars.hpp"
#include "tests/common/constants/pi.hpp"

namespace sonoglide::control::resonance_estimate_test {
namespace {

constexpr double velocity = 0.5;
constexpr double wrong = 0.2;  // radians
constexpr double natural_gain = 0.05;
constexpr double drive = 1e-4;  // turns the vibration by 3e-6 radians a period at most

template <class Scalar>
class Bench {
 public:
  Bench() : estimate_(parameters()) {}

  /// A sample at this angle, the frequency of the drive that of the start.
  bool observe(double angle) {
    const PastCommand<Scalar> command{scaled<Scalar>(drive), {}, 0};
    return estimate_.observe(scaled<Scalar>(velocity * std::cos(angle)),
                             scaled<Scalar>(velocity * std::sin(angle)), command, command);
  }

  /// Believed turn of the vibration against the drive, radians a period.
  double turn() const { return tests::two_pi / 8.0 * numeric::to_real(estimate_.natural()); }

 private:
  static typename ResonanceEstimate<Scalar>::Parameters parameters() {
    typename ResonanceEstimate<Scalar>::Parameters all{};
    const auto rate = numeric::split(1.0 / 64.0);
    all.rate = {scaled<Scalar>(rate.mantissa), rate.exponent};
    all.losses = scaled<Scalar>(drive / velocity / 16.0);
    all.lowest = scaled<Scalar>(-0.4);
    all.highest = scaled<Scalar>(0.4);
    all.rate_gain = scaled<Scalar>(0.99);
    all.losses_gain = scaled<Scalar>(0.0625);
    all.quiet_losses = scaled<Scalar>(0.08);
    all.natural_gain = scaled<Scalar>(natural_gain);
    all.audible = scaled<Scalar>(0.01);
    all.surprise = scaled<Scalar>(0.5);
    return all;
  }

  ResonanceEstimate<Scalar> estimate_;
};

template <class Scalar>
class ResonanceEstimateOf : public testing::Test {};
TYPED_TEST_SUITE(ResonanceEstimateOf, Scalars);

// Readings of the beginning, where the vibration is weak, fade with the cube of the number of those that follow,
// until the gain has fallen to natural_gain.
TYPED_TEST(ResonanceEstimateOf, AWrongFirstTurnFadesWithTheCubeOfTheSamples) {
  Bench<TypeParam> bench;
  EXPECT_TRUE(bench.observe(0.0));
  EXPECT_TRUE(bench.observe(wrong));
  EXPECT_NEAR(bench.turn(), wrong, 0.01 * wrong);
  for (int k = 1; k <= 16; ++k) {
    EXPECT_TRUE(bench.observe(wrong));
    EXPECT_NEAR(std::cbrt(bench.turn() / wrong) * (k + 4.0), 3.2, 0.3) << k;
  }
  for (int k = 17; k <= 80; ++k) {
    bench.observe(wrong);
  }
  const double before = bench.turn();
  bench.observe(wrong);
  EXPECT_NEAR(bench.turn() / before, 1.0 - natural_gain, 0.005);
}

TYPED_TEST(ResonanceEstimateOf, ATurnBeyondAQuarterOfARadianIsASurpriseAndQuickensIt) {
  for (const double turn : {0.24, 0.26, -0.24, -0.26}) {
    const bool surprises = std::abs(turn) > 0.25;
    Bench<TypeParam> bench;
    for (int k = 0; k < 80; ++k) {
      bench.observe(0.0);
    }
    EXPECT_EQ(bench.observe(turn), !surprises) << turn;
    const double before = bench.turn();
    EXPECT_NEAR(before, natural_gain * turn, 0.01 * std::abs(turn));
    EXPECT_TRUE(bench.observe(turn));
    EXPECT_NEAR(bench.turn() / before, surprises ? 0.75 : 1.0 - natural_gain, 0.03) << turn;
  }
}

}  // namespace
}  // namespace sonoglide::control::resonance_estimate_test
