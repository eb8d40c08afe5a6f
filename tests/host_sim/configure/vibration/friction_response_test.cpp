/// The answer of the mean friction to a small change of the velocity, against the contact itself
/// integrated with and without the change.
#include "host_sim/configure/vibration/sensorless_reading.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <limits>

namespace sonoglide::configure::friction_response_test {
namespace {

constexpr double two_pi = 6.283185307179586;

/// What is added to the velocity r + cos(2πt + phase): more cos(2πt + phase) + Re(w exp(λt)).
struct Change {
  double more = 0.0;
  std::complex<double> mode;
};

/// One period of the contact in short steps, from a friction in multiples of Fc: its mean, and the
/// friction at its end.
struct Period {
  double mean = 0.0;
  double end = 0.0;
};

Period period_of(const VibratedContact& contact, double friction, std::complex<double> rate,
                 const Change& change) {
  constexpr int steps = 20000;
  Period result{0.0, friction};
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) / steps;
    const double velocity = contact.velocity_ratio +
                            (1.0 + change.more) * std::cos(two_pi * t + contact.phase) +
                            (change.mode * std::exp(rate * t)).real();
    const double direction = velocity > 0.0 ? 1.0 : -1.0;
    const double end =
        direction + (result.end - direction) *
                        std::exp(-two_pi * contact.dahl_number * std::abs(velocity) / steps);
    result.mean += 0.5 * (result.end + end) / steps;
    result.end = end;
  }
  return result;
}

/// At the end of a period of the steady vibration.
double periodic_friction(const VibratedContact& contact) {
  double friction = 0.0;
  for (int period = 0; period < 60; ++period) {
    friction = period_of(contact, friction, {}, {}).end;
  }
  return friction;
}

/// Means over three periods, of which the first is changed.
std::array<double, 3> means(const VibratedContact& contact, double periodic,
                            std::complex<double> rate, const Change& change) {
  const Period first = period_of(contact, periodic, rate, change);
  const Period second = period_of(contact, first.end, {}, {});
  return {first.mean, second.mean, period_of(contact, second.end, {}, {}).mean};
}

TEST(FrictionResponseTest, IsThatOfTheContactItself) {
  constexpr double little = 1e-3;
  const std::complex<double> rate{-0.01, 1.36};
  for (const double kappa : {0.1, 0.4, 2.0, 20.0}) {
    for (const double ratio : {0.3, 0.6, 0.85}) {
      const VibratedContact contact{ratio, kappa, 1.1};
      const ReadingResponse response = reading_response(contact, rate, {});
      const FrictionResponse bare = friction_response(contact);
      const double periodic = periodic_friction(contact);
      const auto up = means(contact, periodic, rate, {little, {}});
      const auto down = means(contact, periodic, rate, {-little, {}});
      // All later periods together: the third and what is left after it.
      const auto sum_of = [&](const std::array<double, 3>& a, const std::array<double, 3>& b) {
        const double tail = (a[2] - b[2]) / (1.0 - bare.memory);
        return std::array<double, 3>{a[0] - b[0], a[1] - b[1], tail};
      };
      const auto forced = sum_of(up, down);
      const double all = forced[0] + forced[1] + forced[2];
      for (const std::complex<double> w : {std::complex<double>{1.0, 0.0}, {0.0, 1.0}}) {
        const auto mode = sum_of(means(contact, periodic, rate, {0.0, little * w}),
                                 means(contact, periodic, rate, {0.0, -little * w}));
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_NEAR((response.mode[k] * w).real(), mode[k] / all, 0.02)
              << kappa << ", " << ratio << ", " << k;
        }
      }
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(response.forced[k], forced[k] / all, 0.02)
            << kappa << ", " << ratio << ", " << k;
      }
    }
  }
}

/// A stiff Dahl contact is a Coulomb contact.
TEST(FrictionResponseTest, OfAStiffContactIsThatOfCoulombFriction) {
  const std::complex<double> rate{0.0, 1.36};
  const ReadingResponse stiff = reading_response({0.5, 140.0, 0.3}, rate, {});
  const ReadingResponse coulomb =
      reading_response({0.5, std::numeric_limits<double>::infinity(), 0.3}, rate, {});
  EXPECT_NEAR(std::abs(stiff.mode[0] - coulomb.mode[0]), 0.0, 0.1 * std::abs(coulomb.mode[0]));
  // A constant velocity d acts as -d/r of an amplitude (r = Vt/v alone decides).
  const ReadingResponse constant =
      reading_response({0.5, std::numeric_limits<double>::infinity(), 0.3}, {0.0, 0.0}, {});
  EXPECT_NEAR(constant.mode[0].real(), -2.0, 1e-12);
}

/// What the chain takes away again leaves the sum of all periods as it is.
TEST(FrictionResponseTest, ASharpenedReadingAddsUpToOne) {
  const ReadingChain chain{0.6, 0.25, 0.15, 0.3};
  const ReadingResponse response = reading_response({0.6, 0.4, 0.2}, {-0.02, 2.0}, chain);
  EXPECT_NEAR(response.forced[0] + response.forced[1] + response.forced[2], 1.0, 1e-9);
}

/// By how much the mean of a period differs from that of the steady vibration, after many periods with a
/// free vibration, over its amplitude.
double answer_to(const VibratedContact& contact, double periodic, double turn,
                 std::complex<double> amplitude) {
  constexpr double little = 0.02;
  std::array<double, 2> shown{};
  for (std::size_t side = 0; side < 2; ++side) {
    double friction = periodic;
    std::complex<double> mode = (side == 0 ? little : -little) * amplitude;
    for (int period = 0; period < 12; ++period) {
      const Period now = period_of(contact, friction, {0.0, turn}, {0.0, mode});
      friction = now.end;
      shown[side] = now.mean;
      mode *= std::polar(1.0, turn);
    }
  }
  return (shown[0] - shown[1]) / (2.0 * little);
}

/// In quadrature, two free vibrations show the swing of every one.
TEST(RatioSwingTest, IsThatOfTheContactItself) {
  for (const double kappa : {0.1, 2.0, 20.0}) {
    for (const double ratio : {0.3, 0.85}) {
      const VibratedContact contact{ratio, kappa, 1.1};
      const double periodic = periodic_friction(contact);
      for (const double turn : {0.06, 3.1}) {
        const double swing = std::hypot(answer_to(contact, periodic, turn, {1.0, 0.0}),
                                        answer_to(contact, periodic, turn, {0.0, 1.0}));
        EXPECT_NEAR(ratio_swing(contact, turn), swing, 0.05 * swing)
            << kappa << ", " << ratio << ", " << turn;
      }
    }
  }
}

/// Coulomb: ρ = (2/π) asin(r + d) of a velocity d that is constant has the slope 2/(π √(1 − r²)).
TEST(RatioSwingTest, OfASlowModeIsTheSlopeOfTheMap) {
  for (const double ratio : {0.3, 0.6, 0.85}) {
    const VibratedContact contact{ratio, std::numeric_limits<double>::infinity(), 0.3};
    EXPECT_NEAR(ratio_swing(contact, 0.0), 4.0 / two_pi / std::sqrt(1.0 - ratio * ratio), 1e-12);
  }
}

}  // namespace
}  // namespace sonoglide::configure::friction_response_test
