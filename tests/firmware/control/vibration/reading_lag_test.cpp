/// The lag of a reading, and what takes it away.

#include "firmware/control/vibration/reading_lag.hpp"

#include <gtest/gtest.h>

#include "scalars.hpp"

namespace sonoglide::control::reading_lag_test {
namespace {

template <class S>
class LaggingReadingTest : public testing::Test {};
TYPED_TEST_SUITE(LaggingReadingTest, Scalars);

/// A sensor of first order behind a contact of first order.
TYPED_TEST(LaggingReadingTest, ShowsWhatTwoLagsFollow) {
  constexpr double sensor = 0.6;
  constexpr double contact = 0.3;
  const typename LaggingReading<TypeParam>::Parameters nominal{
      numeric::split(scaled<TypeParam>(0.75)), numeric::split(scaled<TypeParam>(0.75))};
  auto given = nominal;
  given.sensor.exponent += 1;  // 1.5 = 0.6/0.4
  given.contact = numeric::split(scaled<TypeParam>(contact / (1.0 - contact)));
  LaggingReading<TypeParam> reading(given);
  double after_contact = 0.3;
  double after_sensor = 0.3;
  for (int k = 0; k < 60; ++k) {
    const double ratio = k / 10 % 2 == 0 ? 0.3 : 0.34;
    after_contact = contact * after_contact + (1.0 - contact) * ratio;
    after_sensor = sensor * after_sensor + (1.0 - sensor) * after_contact;
    EXPECT_NEAR(numeric::to_real(reading.lag_compensated(scaled<TypeParam>(after_sensor))), ratio,
                1e-5)
        << k;
  }
}

TYPED_TEST(LaggingReadingTest, TakesItsFirstReadingForSettledAndNoNewOneTooFar) {
  const typename LaggingReading<TypeParam>::Parameters nominal{{scaled<TypeParam>(0.5), 4},
                                                               {scaled<TypeParam>(0.0), 0}};
  LaggingReading<TypeParam> reading(nominal);
  EXPECT_EQ(numeric::to_real(reading.lag_compensated(scaled<TypeParam>(0.25))), 0.25);
  EXPECT_EQ(numeric::to_real(reading.lag_compensated(scaled<TypeParam>(0.375))), 0.625);
  reading.restart();
  EXPECT_EQ(numeric::to_real(reading.lag_compensated(scaled<TypeParam>(0.125))), 0.125);
}

}  // namespace
}  // namespace sonoglide::control::reading_lag_test
