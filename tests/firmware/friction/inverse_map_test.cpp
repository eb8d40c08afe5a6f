#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "firmware/friction/dahl_friction_ratio.hpp"
#include "firmware/friction/dahl_inverse_map.hpp"
#include "firmware/numeric/fixed.hpp"
#include "tests/common/constants/table_1_numbers.hpp"

namespace sonoglide::friction::inverse_map_test {
namespace {

static_assert(sizeof(dahl_inverse_table) <= 4096, "the inverse map's constants fit 4 KiB");

constexpr double slow = 0x1p-11;

template <class Scalar>
double vibration_velocity(double ratio, double lambda, double speed = slow) {
  const numeric::Split<double> parts = numeric::split(lambda / (2.0 * speed));
  const numeric::Split<Scalar> half_travel{numeric::from_real<Scalar>(parts.mantissa),
                                           parts.exponent};
  return numeric::to_real(dahl_vibration_velocity(numeric::from_real<Scalar>(0.5 * ratio),
                                                  numeric::from_real<Scalar>(speed),
                                                  numeric::floating(half_travel)));
}

template <class Scalar>
double velocity_ratio(double ratio, double lambda, double speed = slow) {
  return speed / vibration_velocity<Scalar>(ratio, lambda, speed);
}

template <class Scalar>
class DahlInverseMap : public testing::Test {};
using Scalars = testing::Types<double, float, numeric::Q31<numeric::Saturating>,
                               numeric::Q31<numeric::Trapping>>;
TYPED_TEST_SUITE(DahlInverseMap, Scalars);

TYPED_TEST(DahlInverseMap, ReturnsToTheRatioWithin0002) {
  double worst = 0.0;
  for (int i = 0; i <= 250; ++i) {
    const double dahl_number = std::pow(10.0, -2.0 + 5.0 * i / 250);
    for (int j = 1; j <= 400; ++j) {
      const double r = 2.0 * j / 400;
      const double ratio = dahl_friction_ratio(r, dahl_number);
      const double lambda = dahl_number * r;
      const double back = velocity_ratio<TypeParam>(ratio, lambda);
      ASSERT_GT(back, 0.0);
      const double error = std::abs(dahl_friction_ratio(back, lambda / back) - ratio);
      ASSERT_LE(error, 0.002) << "r " << r << " Dahl number " << dahl_number;
      worst = std::max(worst, error);
    }
  }
  this->RecordProperty("worst_error_millionths", static_cast<int>(worst * 1e6));
}

/// Largest error of the ratio in 16 bits.
double largest_short_error(double speed) {
  double largest = 0.0;
  for (int i = 0; i <= 250; ++i) {
    const double dahl_number = std::pow(10.0, -2.0 + 5.0 * i / 250);
    for (double r = speed; r <= 1.0; r += 0.005) {
      const double ratio = dahl_friction_ratio(r, dahl_number);
      const double lambda = dahl_number * r;
      const double back = velocity_ratio<numeric::Q15<numeric::Saturating>>(ratio, lambda, speed);
      largest = std::max(largest, std::abs(dahl_friction_ratio(back, lambda / back) - ratio));
    }
  }
  return largest;
}

TEST(ShortDahlInverseMap, ReturnsToTheRatioAsCloselyAsTheSpeedIsFine) {
  EXPECT_LE(largest_short_error(0.4), 0.002);
  EXPECT_LE(largest_short_error(0.1), 0.002);
  EXPECT_LE(largest_short_error(0.0125), 0.008);
}

TYPED_TEST(DahlInverseMap, RisesWithTheRatio) {
  for (double lambda = 1e-4; lambda < 1e4; lambda *= 1.9) {
    double previous = 0.0;
    for (int j = 1; j <= 1000; ++j) {
      const double r = velocity_ratio<TypeParam>(j / 1000.0, lambda);
      ASSERT_GE(r, previous) << "ratio " << j / 1000.0 << " lambda " << lambda;
      ASSERT_LE(r, 1.0);
      previous = r;
    }
    EXPECT_GT(previous, 0.999999);
  }
}

TYPED_TEST(DahlInverseMap, EndsAtTheLargestValue) {
  const double largest = numeric::to_real(numeric::from_code<TypeParam>(INT32_MAX));
  EXPECT_EQ(vibration_velocity<TypeParam>(0.0, 1.0), largest);
  for (const double lambda : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
    // A small friction ratio is between 2/pi and pi/2 of the velocity ratio.
    EXPECT_EQ(vibration_velocity<TypeParam>(0.6 * slow, lambda), largest);
    EXPECT_EQ(vibration_velocity<TypeParam>(0x1p-30, lambda), largest);
    EXPECT_LT(vibration_velocity<TypeParam>(4.0 * slow, lambda), largest);
  }
}

TYPED_TEST(DahlInverseMap, ARatioAboveOneAnswersTheSameInEveryFormat) {
  for (const double ratio : {1.0 + 0x1p-13, 1.01, 1.5}) {
    for (const double lambda : {0.01, 1.0, 100.0}) {
      EXPECT_NEAR(vibration_velocity<TypeParam>(ratio, lambda),
                  vibration_velocity<double>(ratio, lambda), 2e-3)
          << ratio << " " << lambda;
    }
  }
}

// Drive amplitudes at which Table 1 of the paper reaches a ratio, sliding at 26.72 mm/s and at
// 0.1 m/s: v = Vt / v̂(1920 N), λ = Kt Vt/(ω Fc).
TYPED_TEST(DahlInverseMap, GivesTheDriveAmplitudesOfTable1) {
  using tests::Table1;
  const double omega = Table1::carrier_rad_per_s;
  const double peak_m_per_s_per_N = omega * Table1::compliance_m_per_N;
  struct Point {
    double velocity_m_per_s;
    double ratio;
    double force_N;
  };
  for (const Point& point :
       {Point{0.02672, 0.3, 818.6}, Point{0.02672, 0.5, 526.3}, Point{0.02672, 0.7, 367.9},
        Point{0.1, 0.5, 1512.0}, Point{0.1, 0.2, 2814.0}}) {
    const double lambda = Table1::contact_stiffness_N_per_m * point.velocity_m_per_s /
                          (omega * Table1::friction_limit_N);
    const double r = velocity_ratio<TypeParam>(point.ratio, lambda);
    EXPECT_NEAR(point.velocity_m_per_s / (r * peak_m_per_s_per_N), point.force_N,
                0.01 * point.force_N);
  }
}

}  // namespace
}  // namespace sonoglide::friction::inverse_map_test
