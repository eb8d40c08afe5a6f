/// The way to resonance against the closed form of a vibration that friction does not bend.

#include "host_sim/studies/design/study.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/common/constants/pi.hpp"
#include "tests/host_sim/loop/steady/scenes/steady_scenes.hpp"

namespace sonoglide::design::detuning_test {
namespace {

using steady::coulomb;
using steady::resonant;
using steady::table_1;

Detuning detuning_at(const scene::Scene& scene, double ratio) {
  return detune(scene, steady::require_ratio(scene, 0.02672, ratio));
}

// The force is as |1 - Ks/(m w^2)|.
TEST(DetuneTest, ForceFallsWithTheDistanceFromResonance) {
  const steady::Requirement own = steady::require_ratio(table_1(), 0.02672, 0.5);
  const double far = own.motion.drive_force_N / std::abs(1.0 - tuning(table_1()));
  EXPECT_NEAR(tuning(table_1()), 0.0467907, 1e-7);
  for (const DetunedPoint& point : detune(table_1(), own).points) {
    const double distance = std::abs(1.0 - point.tuning);
    EXPECT_NEAR(point.drive_force_N, far * distance, 0.01 * far * distance + 0.02) << point.tuning;
  }
}

TEST(DetuneTest, ReachEndsWhereTheDriveDoes) {
  const Detuning detuning = detuning_at(table_1(), 0.5);
  const double most = 1920.0 / 526.3 * (1.0 - tuning(table_1()));
  ASSERT_TRUE(detuning.reachable);
  EXPECT_EQ(detuning.reachable->low, smallest_tuning);
  EXPECT_NEAR(detuning.reachable->high, 1.0 + most, 0.02 * most);
}

// The same motion rubs the same.
TEST(DetuneTest, PowerIsTheSameOnAnySpring) {
  const steady::SteadyMotion own = steady::require_ratio(table_1(), 0.02672, 0.5).motion;
  for (const double other : {0.01, 0.5, 0.9, 2.0}) {
    const steady::SteadyMotion motion =
        steady::require_ratio(retuned(table_1(), other), 0.02672, 0.5).motion;
    EXPECT_NEAR(motion.drive_power_W, own.drive_power_W, 1e-3 * own.drive_power_W);
    EXPECT_NEAR(motion.apparent_power_W,
                own.apparent_power_W * std::abs(1.0 - other) / (1.0 - tuning(table_1())),
                2e-3 * own.apparent_power_W);
  }
}

// 1 % of Ks is 1 % s/|1 - s| of the vibration at a tuning of s.
TEST(DetuneTest, SensitivityToTheSpringGrowsTowardsResonance) {
  scene::Scene scene = coulomb();
  const double ratio = 0.5;
  const double r = std::sin(0.25 * tests::pi);
  const double by_vibration = r / (std::sqrt(1.0 - r * r) * 0.7853981633974483);
  const Detuning detuning = detuning_at(scene, ratio);
  ASSERT_TRUE(detuning.sensitive);
  const double allowed = scene.run.settling_band / (0.01 * ratio * by_vibration);
  EXPECT_NEAR(detuning.sensitive->low, allowed / (1.0 + allowed), 0.01);
  EXPECT_NEAR(detuning.sensitive->high, allowed / (allowed - 1.0), 0.05);
  for (const double edge : {detuning.sensitive->low, detuning.sensitive->high}) {
    const scene::Scene there = retuned(scene, edge);
    const double force_N = steady::require_ratio(there, 0.02672, ratio).motion.drive_force_N;
    const Sensitivity spring = sensitivities(steady::steady_scene(there, 0.02672, force_N))[1];
    ASSERT_STREQ(spring.parameter.symbol, "Ks");
    EXPECT_NEAR(spring.largest_change(), scene.run.settling_band, 1e-6);
  }
  EXPECT_LT(detuning.force_at_sensitive_low_N,
            steady::require_ratio(scene, 0.02672, ratio).motion.drive_force_N);
}

TEST(DetuneTest, AWideBandLeavesNothingTooSensitive) {
  scene::Scene scene = table_1();
  scene.run.settling_band = 1.0;
  const Detuning detuning = detuning_at(scene, 0.5);
  EXPECT_FALSE(detuning.sensitive);
}

// With a quality of 5 the ratio hardly moves at the top, and most beside it.
TEST(DetuneTest, ADampedResonanceIsFlatAtItsTopAndSteepBesideIt) {
  scene::Scene scene = resonant();
  scene.plant.damping_N_s_per_m = 1500.0;
  scene.drive->max_force_amplitude_N = 500.0;
  const Detuning detuning = detuning_at(scene, 0.5);
  EXPECT_LT(detuning.change_by_stiffness, scene.run.settling_band);
  ASSERT_TRUE(detuning.sensitive);
  EXPECT_LT(detuning.sensitive->low, 0.9);
  EXPECT_GT(detuning.sensitive->high, 1.1);
}

TEST(DetuneTest, ATargetBeyondTheDriveIsReachedNearerToResonance) {
  const steady::Requirement beyond = steady::require_ratio(table_1(), 0.1, 0.2);
  const Detuning detuning = detune(table_1(), beyond);
  ASSERT_TRUE(detuning.reachable);
  const double half = 1920.0 / beyond.motion.drive_force_N * (1.0 - tuning(table_1()));
  EXPECT_NEAR(detuning.reachable->low, 1.0 - half, 0.01);
  EXPECT_NEAR(detuning.reachable->high, 1.0 + half, 0.01);
}

}  // namespace
}  // namespace sonoglide::design::detuning_test
