/// Random contacts whose friction force changes while it is learnt, or is another than was known.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <type_traits>

#include "closed_loop.hpp"
#include "friction/tracked_loop.hpp"
#include "scalars.hpp"

namespace sonoglide::control::changing_friction_test {
namespace {

constexpr double interval = 1.96;  // deviations to either side hold 95 %
constexpr int periods = 600;       // 10 ms at 60 kHz
constexpr int jump_at = 30;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }

 private:
  std::mt19937_64 engine_;
};

template <class S>
class ChangingFrictionTest : public testing::Test {
 protected:
  using Loop = ClosedLoop<TrackingParts<S>>;
  static constexpr int loops = std::is_same_v<S, Trapped> ? 30 : 8;  // of each seed
  static constexpr std::array<std::uint64_t, 3> seeds{3, 14, 159};

  struct Parts {
    double held;  ///< of the periods, in which the interval of Fc holds it
    double
        right;  ///< of those that are counted, in which the ratio is within the band of its target
  };

  static Contact random_contact(Random& random, Design& design) {
    design.contact_force = 0.3 * std::exp(random.between(std::log(0.2), std::log(30.0)));
    return {0.3 / random.between(0.7, 1.3), design.contact_force / random.between(0.5, 1.5),
            random.between(0.98, 1.02)};
  }

  /// Three random targets. @return the last one
  static double settle(Loop& loop, Random& random) {
    double target = 0.5;
    for (int step = 0; step < 3; ++step) {
      target = random.between(0.4, 0.9);
      loop.set_target(target);
      loop.run(120);
    }
    return target;
  }

  /// @param factor  of the friction force, at a part of the time in [0, 1)
  /// @param from    period from which on the ratio is counted
  template <class Factor>
  static Parts parts(const Factor& factor, double band, int from = 0) {
    int held = 0;
    int right = 0;
    int all = 0;
    for (const std::uint64_t seed : seeds) {
      Random random(seed);
      for (int i = 0; i < loops; ++i, ++all) {
        Design design = trusting();
        Contact contact = random_contact(random, design);
        Loop loop(design, contact);
        loop.delay_sensor(1);
        const double target = settle(loop, random);
        const double before = contact.friction_force;
        for (int k = 0; k < periods; ++k) {
          contact.friction_force = before * factor(static_cast<double>(k) / periods);
          loop.set_friction_force(contact.friction_force);
          loop.step();
          held += std::abs(deviations_off(loop, design, contact)[0]) < interval ? 1 : 0;
          right += k >= from && std::abs(loop.ratio() - target) < band ? 1 : 0;
        }
        EXPECT_NE(loop.command().state, State::fault) << seed << " " << i;
      }
    }
    return {static_cast<double>(held) / (all * periods),
            static_cast<double>(right) / (all * (periods - from))};
  }
};
TYPED_TEST_SUITE(ChangingFrictionTest, Scalars);

TYPED_TEST(ChangingFrictionTest, FollowsADrift) {
  for (const double by : {-0.5, -0.2, -0.05, -0.01, 0.0, 0.01, 0.05, 0.2, 0.5}) {
    const auto drift = [by](double part) { return 1.0 + by * part; };
    const auto [held, right] = this->parts(drift, 0.01);
    EXPECT_GE(held, 0.97) << by;
    EXPECT_GE(right, 0.98) << by;
    EXPECT_GE(this->parts(drift, 0.02).right, 0.995) << by;
  }
}

TYPED_TEST(ChangingFrictionTest, FollowsASine) {
  constexpr double two_pi = 6.283185307179586;
  for (const double cycles : {0.5, 1.0}) {
    for (const double by : {0.05, 0.1, 0.2}) {
      const auto swing = [=](double part) { return 1.0 + by * std::sin(two_pi * cycles * part); };
      const auto [held, right] = this->parts(swing, 0.02);
      EXPECT_GE(held, 0.95) << cycles << " " << by;
      EXPECT_GE(right, 0.99) << cycles << " " << by;
    }
  }
}

/// The interval counts from before the jump on, the ratio from 2 ms after it.
TYPED_TEST(ChangingFrictionTest, FollowsAJump) {
  for (const double factor : {0.5, 1.5}) {
    const auto jump = [=](double part) { return part * periods < jump_at ? 1.0 : factor; };
    const auto [held, right] = this->parts(jump, 0.02, jump_at + 120);
    EXPECT_GE(held, 0.93) << factor;
    EXPECT_GE(right, 0.995) << factor;
  }
}

/// A force above twice the friction force believed saturates: not for Trapped.
template <class S>
class UnknownFrictionTest : public ChangingFrictionTest<S> {};
using SaturatingScalars = testing::Types<double, float, Saturated>;
TYPED_TEST_SUITE(UnknownFrictionTest, SaturatingScalars);

/// Far outside of what was known at the start, which is 30 %.
TYPED_TEST(UnknownFrictionTest, FindsAForceThatIsManyTimesAnother) {
  for (const double factor : {0.2, 1.0 / 3.0, 3.0, 5.0}) {
    for (const std::uint64_t seed : this->seeds) {
      Random random(seed);
      for (int i = 0; i < this->loops; ++i) {
        Design design = trusting();
        design.friction_force = 0.1;
        design.contact_force = 0.1 * std::exp(random.between(std::log(0.5), std::log(20.0)));
        const Contact contact{0.1 * factor, design.contact_force, 1.0};
        typename TestFixture::Loop loop(design, contact);
        loop.delay_sensor(1);
        const double target = this->settle(loop, random);
        EXPECT_NEAR(loop.ratio(), target, 0.02) << factor << " " << seed << " " << i;
        for (const double off : deviations_off(loop, design, contact)) {
          EXPECT_LT(std::abs(off), interval) << factor << " " << seed << " " << i;
        }
      }
    }
  }
}

}  // namespace
}  // namespace sonoglide::control::changing_friction_test
