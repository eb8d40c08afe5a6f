// The frequency as a whole number of steps.
#include "firmware/control/vibration/frequency_word.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "scalars.hpp"

namespace sonoglide::control::frequency_word_test {
namespace {

template <class S>
numeric::Split<S> split(double value) {
  const numeric::Split<double> parts = numeric::split(value);
  return {scaled<S>(parts.mantissa), parts.exponent};
}

/// @param step  relative to the start
template <class S>
FrequencyWord<S> word(double step) {
  return FrequencyWord<S>({split<S>(1.0 / (8.0 * step)), split<S>(8.0 * step)});
}

template <class S>
class FrequencyWordOf : public testing::Test {};
TYPED_TEST_SUITE(FrequencyWordOf, Scalars);

TYPED_TEST(FrequencyWordOf, IsNearestWhenItChangesAndStaysWithinThreeQuartersOfAStep) {
  // float32 resolves no more than 2^-24 of the deviation.
  for (const double step : {1.0 / 64.0, 1.8e-3, 1e-4, 3.3e-6}) {
    auto synthesiser = word<TypeParam>(step);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> move(-2.0, 2.0);
    double wanted = 0.0;
    for (int i = 0; i < 20'000; ++i) {
      wanted = std::clamp(wanted + move(random) * step, -0.06, 0.06);
      const std::int32_t before = synthesiser.steps();
      const double found = numeric::to_real(synthesiser.approach(scaled<TypeParam>(8.0 * wanted)));
      const double away = wanted / step - synthesiser.steps();
      const double rounding = 1.0 / 16.0 + 0.06 / step * 0x1p-23;
      ASSERT_LE(std::abs(away), (synthesiser.steps() == before ? 0.75 : 0.5) + rounding);
      ASSERT_NEAR(found, 8.0 * step * synthesiser.steps(), 1e-6) << step;
    }
  }
}

TYPED_TEST(FrequencyWordOf, NoiseOfAQuarterOfAStepMovesNothing) {
  auto synthesiser = word<TypeParam>(1e-3);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> noise(-0.2, 0.2);
  synthesiser.approach(scaled<TypeParam>(8.0 * 10.5e-3));
  const std::int32_t steps = synthesiser.steps();
  for (int i = 0; i < 10'000; ++i) {
    synthesiser.approach(scaled<TypeParam>(8.0 * (10.5 + noise(random)) * 1e-3));
    ASSERT_EQ(synthesiser.steps(), steps);
  }
}

TYPED_TEST(FrequencyWordOf, TheFinestWordHasNoStepsToSee) {
  auto synthesiser = word<TypeParam>(0x1p-28);
  for (const double wanted : {-0.06, -1e-3, 0.0, 3.3e-5, 0.0599}) {
    const double found = numeric::to_real(synthesiser.approach(scaled<TypeParam>(8.0 * wanted)));
    EXPECT_NEAR(found, 8.0 * wanted, 1e-7);
  }
}

}  // namespace
}  // namespace sonoglide::control::frequency_word_test
