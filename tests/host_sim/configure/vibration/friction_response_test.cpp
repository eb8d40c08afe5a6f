/// The answer of the mean friction to a small change of the velocity, against the contact itself
/// integrated with and without the change.
#include "host_sim/configure/vibration/friction_response.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <limits>

namespace sonoglide::configure::friction_response_test {
namespace {

constexpr double two_pi = 6.283185307179586;

/// Means of the friction over three periods, in multiples of Fc, from the periodic friction on: of a
/// velocity r + (1 + more) cos(2πt + phase) + little Re(w exp(λt)), the last in the first period alone.
struct Change {
  double more = 0.0;  ///< of the first period alone
  std::complex<double> mode;
};

std::array<double, 3> means(const VibratedContact& contact, std::complex<double> rate,
                            const Change& change) {
  constexpr int steps = 20000;
  constexpr int settling = 60;
  double friction = 0.0;
  std::array<double, 3> sums{};
  for (int period = -settling; period < 3; ++period) {
    for (int i = 0; i < steps; ++i) {
      const double t = (i + 0.5) / steps;
      const double here = period == 0 ? 1.0 : 0.0;
      const double velocity = contact.velocity_ratio +
                              (1.0 + here * change.more) * std::cos(two_pi * t + contact.phase) +
                              here * (change.mode * std::exp(rate * t)).real();
      const double direction = velocity > 0.0 ? 1.0 : -1.0;
      const double end =
          direction + (friction - direction) *
                          std::exp(-two_pi * contact.dahl_number * std::abs(velocity) / steps);
      if (period >= 0) {
        sums[static_cast<std::size_t>(period)] += 0.5 * (friction + end) / steps;
      }
      friction = end;
    }
  }
  return sums;
}

TEST(FrictionResponseTest, IsThatOfTheContactItself) {
  constexpr double little = 1e-3;
  const std::complex<double> rate{-0.01, 1.36};
  for (const double kappa : {0.1, 0.4, 2.0, 20.0}) {
    for (const double ratio : {0.3, 0.6, 0.85}) {
      const VibratedContact contact{ratio, kappa, 1.1};
      const ReadingResponse response = reading_response(contact, rate, {});
      const FrictionResponse bare = friction_response(contact);
      const auto up = means(contact, rate, {little, {}});
      const auto down = means(contact, rate, {-little, {}});
      // All later periods together: the third and what is left after it.
      const auto sum_of = [&](const std::array<double, 3>& a, const std::array<double, 3>& b) {
        const double tail = (a[2] - b[2]) / (1.0 - bare.memory);
        return std::array<double, 3>{a[0] - b[0], a[1] - b[1], tail};
      };
      const auto forced = sum_of(up, down);
      const double all = forced[0] + forced[1] + forced[2];
      for (const std::complex<double> w : {std::complex<double>{1.0, 0.0}, {0.0, 1.0}}) {
        const auto mode = sum_of(means(contact, rate, {0.0, little * w}),
                                 means(contact, rate, {0.0, -little * w}));
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

}  // namespace
}  // namespace sonoglide::configure::friction_response_test
