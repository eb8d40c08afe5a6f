/// Friction ratios under vibration across the sliding and normal to the surface.

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/quadrature/trapezoidal.hpp>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "firmware/friction/normal_vibration_ratio.hpp"
#include "firmware/friction/transverse_vibration_ratio.hpp"
#include "firmware/numeric/arithmetic_geometric_mean.hpp"
#include "tests/common/constants/pi.hpp"

namespace sonoglide::friction::vibration_direction_test {
namespace {

using tests::pi;
constexpr double unit = std::numeric_limits<double>::epsilon();

/// Near k = 1 the integral tells moduli apart that double and long double do not.
using Precise = boost::multiprecision::cpp_bin_float_100;

/// (2/pi) K(k) with k^2 = 1 - complement^2.
double elliptic_integral(Precise complement) {
  const Precise modulus = sqrt((1 - complement) * (1 + complement));
  const Precise integral = boost::math::ellint_1(modulus);
  return static_cast<double>(integral / boost::math::constants::half_pi<Precise>());
}

TEST(ArithmeticGeometricMean, GivesTheCompleteEllipticIntegral) {
  for (double complement = 1e-30; complement < 1.0; complement *= 1.7) {
    const double mean = 1.0 / elliptic_integral(complement);
    EXPECT_NEAR(numeric::arithmetic_geometric_mean(1.0, complement), mean, 4.0 * unit * mean)
        << complement;
    EXPECT_NEAR(numeric::arithmetic_geometric_mean(complement, 1.0), mean, 4.0 * unit * mean);
  }
  // Gauss's constant is 1/M(1, sqrt 2).
  EXPECT_NEAR(1.0 / numeric::arithmetic_geometric_mean(1.0, std::sqrt(2.0)), 0.8346268416740731,
              4.0 * unit);
  EXPECT_EQ(numeric::arithmetic_geometric_mean(3.0, 3.0), 3.0);
}

TEST(TransverseVibrationRatio, MatchesPublishedValues) {
  EXPECT_NEAR(transverse_vibration_ratio(0.1), 0.23442, 5e-6);
  EXPECT_NEAR(transverse_vibration_ratio(0.5), 0.64264, 5e-6);
  EXPECT_NEAR(transverse_vibration_ratio(1.0), 0.83463, 5e-6);
}

TEST(TransverseVibrationRatio, IsTheEllipticIntegral) {
  for (double r = 1e-6; r < 1e6; r *= 1.3) {
    const Precise complement = Precise(r) / sqrt(1 + Precise(r) * r);
    const double ratio = static_cast<double>(complement) * elliptic_integral(complement);
    EXPECT_NEAR(transverse_vibration_ratio(r), ratio, 8.0 * unit * ratio) << r;
    EXPECT_NEAR(transverse_vibration_ratio(static_cast<float>(r)), ratio, 1e-6 * ratio) << r;
    EXPECT_EQ(transverse_vibration_ratio(-r), transverse_vibration_ratio(r));
  }
}

TEST(TransverseVibrationRatio, IsTheMeanOfCoulombFrictionAlongTheSliding) {
  for (double r = 0.05; r < 3.0; r += 0.05) {
    const auto along = [r](double phase) {
      const double across = std::cos(phase);
      return r / std::sqrt(r * r + across * across);
    };
    const double mean = boost::math::quadrature::trapezoidal(along, 0.0, pi, 1e-13) / pi;
    EXPECT_NEAR(transverse_vibration_ratio(r), mean, 1e-12) << r;
  }
}

TEST(TransverseVibrationRatio, HasItsLimits) {
  EXPECT_EQ(transverse_vibration_ratio(0.0), 0.0);
  EXPECT_NEAR(transverse_vibration_ratio(1e-4), 2.0 / pi * 1e-4 * std::log(4e4), 1e-11);
  EXPECT_NEAR(transverse_vibration_ratio(1e3), 1.0 - 0.25e-6, 1e-12);
  EXPECT_EQ(transverse_vibration_ratio(std::numeric_limits<double>::max()), 1.0);
  const double least = std::numeric_limits<double>::min();
  EXPECT_NEAR(transverse_vibration_ratio(least) / least,
              2.0 / pi * (std::log(4.0) - std::log(least)), 1e-9);
}

/// Mean tangential force of the contact itself, of its friction limit's mean: step by step the
/// spring stretches, and no further than the limit, from a whole period before.
double followed_in_time(double amplitude_ratio, double velocity_ratio) {
  constexpr int steps = 100000;
  const double stretch = amplitude_ratio * velocity_ratio * 2.0 * pi / steps;
  double force = 1.0;
  double sum = 0.0;
  for (int i = 0; i < 2 * steps; ++i) {
    const double limit = 1.0 + amplitude_ratio * std::cos(2.0 * pi * i / steps);
    force = std::min(force + stretch, limit);
    sum += i < steps ? 0.0 : force;
  }
  return sum / steps;
}

TEST(NormalVibrationRatio, FollowsTheContactInTime) {
  for (const double amplitude : {0.2, 0.7, 1.0}) {
    for (double speed = 0.005; speed < 1.3; speed += 0.05) {
      EXPECT_NEAR(normal_vibration_ratio(amplitude, speed), followed_in_time(amplitude, speed),
                  1e-4)
          << amplitude << ' ' << speed;
    }
  }
}

/// Psi by bracketing and quadrature: the phase from which the slider sticks is where the limit
/// rises as fast as the spring is stretched, that at which it slips again where they meet.
long double reduction_by_quadrature(long double s) {
  using std::cos;
  const long double begin = boost::math::constants::pi<long double>() + std::asin(s);
  const auto above = [&](long double phase) {
    return cos(phase) - cos(begin) - s * (phase - begin);
  };
  const long double low = begin + 2.0L * std::acos(s);
  const long double turn = boost::math::constants::two_pi<long double>();
  std::uintmax_t iterations = 200;
  const auto end = boost::math::tools::toms748_solve(
      above, low, begin + turn, boost::math::tools::eps_tolerance<long double>(60), iterations);
  return boost::math::quadrature::gauss_kronrod<long double, 61>::integrate(above, begin, end.first,
                                                                            5, 1e-17L) /
         turn;
}

TEST(NormalVibrationRatio, IsTheIntegralOfTheForceThatTheSliderMisses) {
  for (const double speed : {1e-6, 1e-3, 0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.9999}) {
    const auto reduction =
        static_cast<double>(reduction_by_quadrature(static_cast<long double>(speed)));
    EXPECT_NEAR(normal_vibration_ratio(1.0, speed), 1.0 - reduction, 1e-14) << speed;
    EXPECT_NEAR(normal_vibration_ratio(0.3, speed), 1.0 - 0.3 * reduction, 1e-14) << speed;
    EXPECT_NEAR(normal_vibration_ratio(1.0F, static_cast<float>(speed)), 1.0 - reduction, 1e-6)
        << speed;
  }
}

TEST(NormalVibrationRatio, IsNearThePublishedFit) {
  double furthest = 0.0;
  for (double speed = 0.005; speed < 1.3; speed += 0.005) {
    const double below = 1.0 - std::min(speed, 1.0);
    const double fit = 0.75 * std::pow(below, 2) + 0.25 * std::pow(below, 4);
    const double above = fit - (1.0 - normal_vibration_ratio(1.0, speed));
    EXPECT_GE(above, -1e-12) << speed;
    EXPECT_LE(above, 0.015) << speed;
    furthest = std::max(furthest, above);
  }
  EXPECT_GE(furthest, 0.013) << "the docstring gives a bound that is too wide";
}

TEST(NormalVibrationRatio, HasItsLimits) {
  for (const double amplitude : {0.0, 0.3, 1.0}) {
    EXPECT_NEAR(normal_vibration_ratio(amplitude, 0.0), 1.0 - amplitude, 1e-15);
    EXPECT_EQ(normal_vibration_ratio(amplitude, 1.0), 1.0);
    EXPECT_EQ(normal_vibration_ratio(amplitude, 40.0), 1.0);
    EXPECT_EQ(normal_vibration_ratio(amplitude, -0.4), normal_vibration_ratio(amplitude, 0.4));
  }
}

}  // namespace
}  // namespace sonoglide::friction::vibration_direction_test
