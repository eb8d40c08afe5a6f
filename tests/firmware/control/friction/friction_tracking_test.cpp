/// Friction that is learnt while driving: the filter against a batch of normal equations, and the loop
/// around contacts that are not what the controller was designed for.

#include "firmware/control/friction/friction_tracking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

#include "closed_loop.hpp"
#include "firmware/numeric/turn.hpp"
#include "friction/tracked_loop.hpp"
#include "scalars.hpp"

namespace sonoglide::control::friction_tracking_test {
namespace {

using Matrix = std::array<Vector, 3>;

Matrix inverse(Matrix a) {
  Matrix b{{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}};
  for (std::size_t i = 0; i < 3; ++i) {
    const double pivot = a[i][i];
    for (std::size_t k = 0; k < 3; ++k) {
      a[i][k] /= pivot;
      b[i][k] /= pivot;
    }
    for (std::size_t j = 0; j < 3; ++j) {
      const double factor = j == i ? 0.0 : a[j][i];
      for (std::size_t k = 0; k < 3; ++k) {
        a[j][k] -= factor * a[i][k];
        b[j][k] -= factor * b[i][k];
      }
    }
  }
  return b;
}

template <class S>
class FrictionEstimateTest : public testing::Test {};
TYPED_TEST_SUITE(FrictionEstimateTest, Scalars);

/// The information of a batch of linear readings is the sum of what each one has.
TYPED_TEST(FrictionEstimateTest, IsTheMaximumAPosterioriEstimateOfABatch) {
  using Estimate = FrictionEstimate<TypeParam>;
  const auto real = [](TypeParam x) { return numeric::to_real(x); };
  const Vector prior = {0.09, 0.25, 0.01};
  const Vector truth = {0.10, -0.20, 0.05};
  const std::vector<std::pair<Vector, double>> readings = {
      {{1.0, 0.0, 0.0}, 0.02}, {{1.2, -0.2, -0.5}, 0.02}, {{1.1, -0.1, -0.7}, 0.03}};
  Estimate estimate(
      {scaled<TypeParam>(prior[0]), scaled<TypeParam>(prior[1]), scaled<TypeParam>(prior[2])});
  Matrix information{
      {{1.0 / prior[0], 0.0, 0.0}, {0.0, 1.0 / prior[1], 0.0}, {0.0, 0.0, 1.0 / prior[2]}}};
  Vector weighed{};
  Vector found{};
  for (const auto& [slope, deviation] : readings) {
    // What the second order leaves out adds to the variance of the reading.
    const auto& before = estimate.variance();
    const double neglected = -slope[1] * real(before.stiffness) - slope[2] * real(before.gain);
    const double variance = deviation * deviation + neglected * neglected;
    double shown = 0.0;
    double expected = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      shown += slope[i] * truth[i];
      expected += slope[i] * found[i];
    }
    for (std::size_t i = 0; i < 3; ++i) {
      weighed[i] += slope[i] * shown / variance;
      for (std::size_t j = 0; j < 3; ++j) {
        information[i][j] += slope[i] * slope[j] / variance;
      }
    }
    ASSERT_TRUE(estimate.weigh({{scaled<TypeParam>(slope[0] / 2), scaled<TypeParam>(slope[1] / 2),
                                 scaled<TypeParam>(slope[2] / 2)},
                                scaled<TypeParam>(deviation / 2),
                                scaled<TypeParam>((shown - expected) / 2)},
                               true, false));
    const auto moved = estimate.take();
    found[0] += 2.0 * real(moved.force);
    found[1] += 2.0 * real(moved.stiffness);
    found[2] += 2.0 * real(moved.gain);
  }
  const Matrix covariance = inverse(information);
  const auto& left = estimate.variance();
  const Vector variances = {real(left.force), real(left.stiffness), real(left.gain)};
  for (std::size_t i = 0; i < 3; ++i) {
    double best = 0.0;
    for (std::size_t j = 0; j < 3; ++j) {
      best += covariance[i][j] * weighed[j];
    }
    EXPECT_NEAR(found[i], best, 1e-3) << i;
    // Each reading makes each constant less certain by 4e-6.
    EXPECT_NEAR(variances[i], covariance[i][i], 0.01 * covariance[i][i] + 1.2e-5) << i;
  }
}

TYPED_TEST(FrictionEstimateTest, LeavesOutWhatShowsNothingNew) {
  using Estimate = FrictionEstimate<TypeParam>;
  Estimate estimate({scaled<TypeParam>(1e-4), scaled<TypeParam>(0.01), scaled<TypeParam>(1e-4)});
  typename Estimate::Reading reading{
      {scaled<TypeParam>(0.55), scaled<TypeParam>(-0.05), scaled<TypeParam>(-0.2)},
      scaled<TypeParam>(0.002),
      scaled<TypeParam>(0.01)};
  EXPECT_FALSE(estimate.weigh(reading, false, false));
  reading.innovation = scaled<TypeParam>(0.2);  // a friction that has become half as large again
  EXPECT_TRUE(estimate.weigh(reading, false, false));
  const auto moved = estimate.take();
  EXPECT_NEAR(2.0 * numeric::to_real(moved.force), 0.4 / 1.1, 0.04);
}

template <class S>
class FrictionTrackingTest : public testing::Test {
 protected:
  using Loop = ClosedLoop<TrackingParts<S>>;
  static constexpr int loops = std::is_same_v<S, Trapped> ? 200 : 20;

  struct Tally {
    int right = 0;              ///< loops whose true ratio is within 0.02 of its target
    std::array<int, 3> held{};  ///< in which the interval of 95 % holds Fc, Kt, g
    std::array<int, 3> far{};   ///< in which it is off by more than four deviations
    Vector median{};            ///< of the deviation that is told
  };

  /// Random contacts after random targets.
  /// @param known       deviation of ln g as the controller knows it
  /// @param least,most  of the true gain
  static Tally tally(double known, double least, double most, int targets = 3) {
    std::mt19937_64 random(7);
    const auto between = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    Tally tally;
    std::array<std::vector<double>, 3> told;
    for (int i = 0; i < loops; ++i) {
      Design design = trusting();
      design.gain_deviation = known;
      design.contact_force = 0.3 * std::exp(between(std::log(0.2), std::log(30.0)));
      const Contact contact{0.3 / between(0.7, 1.3), design.contact_force / between(0.5, 1.5),
                            between(least, most)};
      Loop loop(design, contact);
      loop.delay_sensor(1);
      for (int step = 1; step <= targets; ++step) {
        const double target = between(0.4, 0.9);
        loop.set_target(target);
        loop.run(120);
        tally.right += step == targets && std::abs(loop.ratio() - target) < 0.02 ? 1 : 0;
      }
      const Vector deviations = deviations_off(loop, design, contact);
      const Vector stated = stated_deviations(loop);
      for (std::size_t k = 0; k < 3; ++k) {
        told[k].push_back(stated[k]);
        tally.held[k] += std::abs(deviations[k]) < 1.96 ? 1 : 0;
        tally.far[k] += std::abs(deviations[k]) > 4.0 ? 1 : 0;
      }
      EXPECT_NE(loop.command().state, State::fault) << i;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const auto middle = told[k].begin() + loops / 2;
      std::nth_element(told[k].begin(), middle, told[k].end());
      tally.median[k] = *middle;
    }
    return tally;
  }
};
TYPED_TEST_SUITE(FrictionTrackingTest, Scalars);

TYPED_TEST(FrictionTrackingTest, HoldsTheTrueRatioOfAFrictionThatJumps) {
  const Design design = trusting();
  for (const double factor : {0.5, 1.5}) {
    Contact contact{0.3 / 1.3, 1.0108 / 1.5, 1.0};
    typename TestFixture::Loop loop(design, contact);
    loop.delay_sensor(1);
    for (const double target : {0.4, 0.6, 0.5}) {
      loop.set_target(target);
      loop.run(120);
      EXPECT_NEAR(loop.ratio(), target, 0.01) << factor;
      EXPECT_EQ(loop.command().limit, Limit::none);
    }
    loop.set_friction_force(factor * contact.friction_force);
    loop.run(300);
    EXPECT_NEAR(loop.ratio(), 0.5, 0.02) << factor;
    EXPECT_EQ(loop.command().fault, Fault::none);
  }
}

TYPED_TEST(FrictionTrackingTest, IsAsCertainAsItIsRight) {
  for (const double range : {0.02, 0.25}) {
    const auto found = this->tally(range, 1.0 - range, 1.0 + range);
    EXPECT_GE(found.right, this->loops * 98 / 100) << range;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_GE(found.held[k], this->loops * 95 / 100) << range << " " << k;
      EXPECT_LE(found.far[k], this->loops / 100) << range << " " << k;
    }
  }
}

/// A mass that rings lowers the force of some periods of each cycle. Noise is no ringing.
TYPED_TEST(FrictionTrackingTest, TakesTheHighestForceOfADipInWhichTheMassRings) {
  const Design design = trusting();
  const Contact contact{0.3 / 1.1, 1.0108, 1.0};
  const auto learnt = [&](const auto& change) {
    typename TestFixture::Loop loop(design, contact);
    loop.delay_sensor(1);
    loop.set_target(0.5);
    for (int i = 0; i < 120; ++i) {
      const bool dips = loop.controller.relearning().pausing();
      loop.step(0.1, dips ? contact.friction_force * change(i) : 0.0);
    }
    EXPECT_NEAR(numeric::to_real(loop.controller.friction_level().force()), contact.friction_force,
                0.015 * contact.friction_force);
    EXPECT_LT(std::abs(deviations_off(loop, design, contact)[0]), 1.96);
    return stated_deviations(loop)[0];
  };
  for (const double depth : {0.1, 0.3}) {
    for (const double turns : {0.13, 0.21, 0.34, 0.47}) {
      const double stated = learnt(
          [&](int i) { return depth * std::min(0.0, std::sin(numeric::two_pi * turns * i)); });
      EXPECT_GT(stated, 0.1 * depth) << turns;
      EXPECT_LT(stated, 0.4 * depth) << turns;
    }
  }
  EXPECT_LT(learnt([](int i) { return i % 2 == 0 ? 0.004 : -0.004; }), 0.008);
}

/// Up to eight deviations off. Kt takes part of the error, so that not every contact shows it.
TYPED_TEST(FrictionTrackingTest, IsNotSureByAGainThatIsNoneOfWhatWasKnown) {
  for (const double gain : {0.85, 0.9, 1.1, 1.15}) {
    for (const int targets : {1, 2, 3}) {
      const auto found = this->tally(0.02, gain, gain, targets);
      if (targets == 3) {
        EXPECT_GE(found.right, this->loops * 98 / 100) << gain;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_GE(found.held[k], this->loops * 99 / 100) << gain << " " << targets << " " << k;
        EXPECT_EQ(found.far[k], 0) << gain << " " << targets << " " << k;
      }
    }
  }
}

/// Readings tell Kt and g from each other, whatever the start: what is told of the gain is narrower than the ±20 %
/// that cover an unforeseen one.
TYPED_TEST(FrictionTrackingTest, IsSureOfAGainThatReadingsTell) {
  const double start = this->tally(0.02, 0.98, 1.02, 1).median[2];
  const double later = this->tally(0.02, 0.98, 1.02, 5).median[2];
  EXPECT_LT(start, 0.112);
  EXPECT_LT(later, 0.04);
}

/// Readings at different requests that no Kt and g of before explain: neither is sure any more.
TYPED_TEST(FrictionEstimateTest, IsNotSureOfWhatAReadingElsewhereContradicts) {
  using Estimate = FrictionEstimate<TypeParam>;
  Estimate estimate({scaled<TypeParam>(1e-4), scaled<TypeParam>(0.01), scaled<TypeParam>(1e-4)});
  const typename Estimate::Reading reading{
      {scaled<TypeParam>(0.55), scaled<TypeParam>(-0.05), scaled<TypeParam>(-0.2)},
      scaled<TypeParam>(0.002),
      scaled<TypeParam>(0.1)};
  Estimate jumped = estimate;
  EXPECT_TRUE(jumped.weigh(reading, false, false));
  EXPECT_FALSE(jumped.contradicted());
  EXPECT_TRUE(estimate.weigh(reading, true, true));
  EXPECT_TRUE(estimate.contradicted());
  EXPECT_LT(numeric::to_real(estimate.take().gain), 10.0 * numeric::to_real(jumped.take().gain));
  estimate.forget();
  EXPECT_TRUE(estimate.contradicted());
  EXPECT_GT(numeric::to_real(estimate.variance().gain), 0.01);
  estimate.restart();
  EXPECT_FALSE(estimate.contradicted());
  EXPECT_LT(numeric::to_real(estimate.variance().gain), 0.001);
}

}  // namespace
}  // namespace sonoglide::control::friction_tracking_test
