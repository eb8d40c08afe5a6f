/// Steady sliding that excites itself, and the drives that quench it: against averaging by hand and
/// against the motion itself.
#include "host_sim/loop/steady/self_excitation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <vector>

#include "host_sim/loop/plant/steady_orbit.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/loop/steady/requirement.hpp"
#include "host_sim/loop/watch.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/host_sim/loop/steady/scenes/steady_scenes.hpp"

namespace sonoglide::steady::self_excitation_test {
namespace {

using tests::pi;
using tests::two_pi;

/// mu = mu_s - alpha v + beta v^3 under a normal force N.
struct Curve {
  double mu_s;
  double alpha;
  double beta;
  double normal_N;
};

/// A mass on a belt, undamped, with a natural mode that is slow against the drive.
scene::Scene belt(const Curve& curve, double mass_kg, double natural_Hz, double carrier_Hz) {
  scene::Scene scene;
  scene.plant.mass_kg = mass_kg;
  scene.plant.stiffness_N_per_m = mass_kg * std::pow(two_pi * natural_Hz, 2);
  scene.friction.law = scene::laws::Stribeck{curve.alpha, curve.beta};
  scene.friction.coefficient = curve.mu_s;
  scene.friction.normal_force_N = curve.normal_N;
  scene.drive.emplace();
  scene.drive->frequency_Hz = carrier_Hz;
  return scene;
}

constexpr Curve published = {0.4, 2.0, 7.5, 10.0};
constexpr double belt_m_per_s = 0.02;

scene::Scene published_belt() {
  scene::Scene scene = belt(published, 1.0, 100.0 / two_pi, 2e3);
  scene.plant.stiffness_N_per_m = 1e4;
  return scene;
}

/// Slope of the averaged friction over the belt speed, v > Vt.
double slope_N_s_per_m(const Curve& c, double sliding, double v) {
  return c.normal_N * (2.0 / pi * c.mu_s / std::sqrt(v * v - sliding * sliding) - c.alpha +
                       3.0 * c.beta * sliding * sliding + 1.5 * c.beta * v * v);
}

/// Edges of the published example: the roots of its slope, and the speed of the belt itself.
TEST(DriveWindowsTest, AreThoseOfAveragingOnASlowMode) {
  const scene::Scene scene = published_belt();
  const double per_m_per_s = force_N(scene, 1.0);
  const std::vector<DriveWindow> windows = drive_windows(scene, belt_m_per_s, 0.5 * per_m_per_s);
  ASSERT_EQ(windows.size(), 4U);
  const std::vector<Fate> fates = {Fate::grows, Fate::dies_out, Fate::grows, Fate::dies_out};
  const std::vector<double> edges = {belt_m_per_s, 0.147074864502479, 0.32857223524365475};
  for (std::size_t i = 0; i < windows.size(); ++i) {
    EXPECT_EQ(windows[i].fate, fates[i]);
    if (i < edges.size()) {
      EXPECT_NEAR(windows[i].high_N / per_m_per_s, edges[i], 0.005 * edges[i]);
      EXPECT_EQ(windows[i].high_N, windows[i + 1].low_N);
    }
  }
  EXPECT_EQ(windows.front().low_N, 0.0);
  EXPECT_EQ(windows.back().high_N, 0.5 * per_m_per_s);
  const std::vector<DriveWindow> averaged =
      averaged_drive_windows(scene, belt_m_per_s, 0.5 * per_m_per_s);
  ASSERT_EQ(averaged.size(), 4U);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    EXPECT_NEAR(averaged[i].high_N / per_m_per_s, edges[i], 2e-5 * edges[i]);
  }
}

/// How much more the drive can than it takes hides no window.
TEST(DriveWindowsTest, AreTheSameUnderAnyLimit) {
  const scene::Scene scene = published_belt();
  const double per_m_per_s = force_N(scene, 1.0);
  const std::vector<double> edges = {belt_m_per_s, 0.147074864502479, 0.32857223524365475};
  for (const double most_m_per_s : {1.0, 80.0}) {
    SCOPED_TRACE(most_m_per_s);
    const auto windows = drive_windows(scene, belt_m_per_s, most_m_per_s * per_m_per_s);
    const auto averaged = averaged_drive_windows(scene, belt_m_per_s, most_m_per_s * per_m_per_s);
    ASSERT_EQ(windows.size(), 4U);
    ASSERT_EQ(averaged.size(), 4U);
    for (std::size_t i = 0; i < edges.size(); ++i) {
      EXPECT_NEAR(windows[i].high_N / per_m_per_s, edges[i], 0.005 * edges[i]);
      EXPECT_NEAR(averaged[i].high_N / per_m_per_s, edges[i], 2e-5 * edges[i]);
    }
  }
}

/// A damper that leaves of the falling part of the curve a window of 1.6 % of its force, narrower than the
/// steps of the scan.
TEST(DriveWindowsTest, ANarrowWindowOfTheAverageIsFound) {
  scene::Scene scene = published_belt();
  scene.drive->frequency_Hz = 200.0;
  const auto slope_at = [](double v) { return slope_N_s_per_m(published, belt_m_per_s, v); };
  double least_m_per_s = 0.1;
  for (double v = least_m_per_s; v < 0.5; v += 1e-5) {
    least_m_per_s = slope_at(v) < slope_at(least_m_per_s) ? v : least_m_per_s;
  }
  scene.plant.damping_N_s_per_m = -slope_at(1.008 * least_m_per_s);
  ASSERT_GT(scene.plant.damping_N_s_per_m, 0.0);
  const double least_N = force_N(scene, least_m_per_s);
  for (const double most : {2.0, 4.4, 300.0, 1e6}) {
    SCOPED_TRACE(most);
    const auto averaged = averaged_drive_windows(scene, belt_m_per_s, most * least_N);
    const auto found = std::find_if(averaged.begin(), averaged.end(), [&](const DriveWindow& each) {
      return each.low_N < least_N && least_N < each.high_N;
    });
    ASSERT_NE(found, averaged.end());
    EXPECT_EQ(found->fate, Fate::grows);
    EXPECT_NEAR((found->high_N - found->low_N) / least_N, 0.016, 0.003);
  }
}

/// Undriven: m x'' + F'(Vt) x' + Ks x = 0, to the last digit that the differences leave.
TEST(SteadySlidingTest, UndrivenGrowsByTheSlopeOfItsFriction) {
  const scene::Scene scene = published_belt();
  for (const double sliding : {0.005, 0.02, 0.1, 0.25}) {
    const double slope =
        published.normal_N * (3.0 * published.beta * sliding * sliding - published.alpha);
    const double expected = std::exp(-0.5 * slope / scene.plant.mass_kg / 2e3);
    const SteadySliding found = steady_sliding(scene, sliding, 0.0);
    EXPECT_NEAR(found.multiplier, expected, 1e-7);
    EXPECT_NEAR(found.averaged_multiplier, expected, 1e-10);
    EXPECT_EQ(found.fate(), 2.0 > 22.5 * sliding * sliding ? Fate::grows : Fate::dies_out);
  }
}

/// A soft spring under the friction is far longer than the vibration; a difference that is a part of
/// its length would turn the sliding.
TEST(SteadySlidingTest, IsExactOnAnySpring) {
  for (const double stiffness_N_per_m : {1e6, 1e3, 80.0, 8.0}) {
    SCOPED_TRACE(stiffness_N_per_m);
    scene::Scene scene = published_belt();
    scene.plant.stiffness_N_per_m = stiffness_N_per_m;
    const double reversing_N = force_N(scene, belt_m_per_s);
    for (const double drive_N : {0.0, 0.5 * reversing_N}) {
      const SteadySliding found = steady_sliding(scene, belt_m_per_s, drive_N);
      const double squares =
          3.0 * belt_m_per_s * belt_m_per_s + 1.5 * std::pow(found.vibration_m_per_s, 2);
      const double damping = published.normal_N * (published.beta * squares - published.alpha);
      const std::complex<double> root =
          std::sqrt(std::complex<double>(damping * damping - 4.0 * stiffness_N_per_m));
      EXPECT_NEAR(std::log(found.multiplier), 0.5 * (root.real() - damping) / 2e3, 1e-6);
    }
    const std::vector<DriveWindow> windows = drive_windows(scene, belt_m_per_s, 2.0 * reversing_N);
    ASSERT_GE(windows.size(), 2U);
    EXPECT_EQ(windows.front().fate, Fate::grows);
    EXPECT_NEAR(windows.front().high_N, reversing_N, 1e-3 * reversing_N);
  }
}

/// Random contacts and speeds: averaging by hand, away from the speed at which the belt is overtaken.
TEST(SteadySlidingTest, IsThatOfAveragingOnRandomBelts) {
  std::mt19937_64 random(20);
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, std::uniform_real_distribution<>(0.0, 1.0)(random));
  };
  int compared = 0;
  for (int i = 0; i < 80; ++i) {
    Curve curve{between(0.1, 0.6), between(0.2, 3.0), 0.0, between(1.0, 30.0)};
    curve.beta =
        between(1.2, 6.0) * 4.0 * std::pow(curve.alpha, 3) / (27.0 * curve.mu_s * curve.mu_s);
    const double mass_kg = between(0.3, 5.0);
    const scene::Scene scene = belt(curve, mass_kg, between(8.0, 25.0), between(4e3, 2e4));
    const double sliding = between(3e-3, 0.1);
    const double v = sliding * between(1.3, 12.0);
    const double slope = slope_N_s_per_m(curve, sliding, v);
    if (slope * slope > 0.25 * mass_kg * scene.plant.stiffness_N_per_m) {
      continue;  // friction would hold the mode against its spring
    }
    ++compared;
    const double expected = -0.5 * slope / mass_kg / scene.drive->frequency_Hz;
    const SteadySliding found = steady_sliding(scene, sliding, force_N(scene, v));
    EXPECT_NEAR(std::log(found.averaged_multiplier), expected, 1e-6 * std::abs(expected) + 1e-9);
    if (std::isnan(found.multiplier)) {
      EXPECT_LT(std::abs(expected), 1e-5)
          << "an orbit that neither attracts nor repels may be missed";
      continue;
    }
    EXPECT_NEAR(std::log(found.multiplier), expected, 0.02 * std::abs(expected) + 3e-6)
        << "belt " << i << ", slope " << slope;
  }
  EXPECT_GE(compared, 50);
}

/// What the multiplier says of a deviation is what a run makes of it.
TEST(SteadySlidingTest, IsWhatARunShows) {
  constexpr int periods = 400;
  for (const double v : {0.13, 0.16, 0.2245, 0.32, 0.36}) {
    scene::Scene scene = published_belt();
    const double drive_N = force_N(scene, v);
    const double multiplier = steady_sliding(scene, belt_m_per_s, drive_N).multiplier;
    scene::Scene run = steady_scene(scene, belt_m_per_s, drive_N);
    const loop::SteadyOrbit orbit = loop::find_orbit(run, most_steps);
    const double size_m = 1e-6;
    run.run.start = scene::Start::given;
    run.run.duration_s = periods / run.drive->frequency_Hz;
    const auto end = [&](double deviation_m) {
      run.plant.initial_displacement_m = orbit.state.displacement_m + deviation_m;
      run.plant.initial_velocity_m_per_s = orbit.state.velocity_m_per_s;
      return loop::run(run).final_state;
    };
    const loop::PlantState high = end(size_m);
    const loop::PlantState low = end(-size_m);
    const double natural = std::sqrt(run.plant.stiffness_N_per_m / run.plant.mass_kg);
    const double grown = std::hypot(high.displacement_m - low.displacement_m,
                                    (high.velocity_m_per_s - low.velocity_m_per_s) / natural) /
                         (2.0 * size_m);
    // The energy of a slow mode swings about its mean by its damping over a turn.
    EXPECT_NEAR(std::log(grown) / periods, std::log(multiplier),
                0.02 * std::abs(std::log(multiplier)) + 1e-5)
        << v;
  }
}

TEST(FrictionFallsTest, TellsTheLawsApart) {
  for (const scene::Scene& scene : {table_1(), coulomb(), iwan(), transverse(), normal()}) {
    EXPECT_FALSE(friction_falls(scene.friction)) << scene::name_of(scene.friction.law);
  }
  EXPECT_TRUE(friction_falls(stribeck().friction));
  EXPECT_TRUE(friction_falls(lugre().friction));
  scene::Scene level = stribeck();
  level.friction.law = scene::laws::Stribeck{0.0, 0.0};
  EXPECT_FALSE(friction_falls(level.friction));
}

/// LuGre friction near 1 is that of a vibration slower than the sliding, which quenches nothing.
TEST(RequireRatioTest, NamesAnUnstableMotion) {
  const scene::Scene scene = falling_lugre();
  const Requirement found = require_ratio(scene, 0.03, 0.97);
  EXPECT_EQ(found.limit, Obstacle::unstable) << found.reason;
  EXPECT_STREQ(name(found.limit), "unstable");
  EXPECT_NEAR(orbit_ratio(steady_scene(scene, 0.03, found.unstable_force_N)), 0.97, 1e-6);
  EXPECT_EQ(steady_sliding(scene, 0.03, found.unstable_force_N).fate(), Fate::grows);
  EXPECT_TRUE(std::isnan(found.reachable_ratio));
  EXPECT_TRUE(std::isnan(found.motion.drive_force_N));
  EXPECT_EQ(require_ratio(scene, 0.03, 0.5).limit, Obstacle::none);
}

// 0.1 g on the published belt: a deviation grows by exp(99.6) in a period of the drive.
TEST(SteadySlidingTest, WhereADeviationGrowsBeyondReasonNothingIsLookedFor) {
  scene::Scene light = published_belt();
  light.plant.mass_kg = 1e-4;
  const SteadySliding undriven = steady_sliding(light, belt_m_per_s, 0.0);
  EXPECT_EQ(undriven.fate(), Fate::unknown);
  EXPECT_EQ(undriven.averaged_fate(), Fate::grows);
  EXPECT_GT(undriven.averaged_multiplier, largest_growth);
  // As far as it is looked for, it is found.
  light.plant.mass_kg = 1e-2;
  const SteadySliding heavier = steady_sliding(light, belt_m_per_s, 0.0);
  EXPECT_EQ(heavier.fate(), Fate::grows);
  EXPECT_NEAR(heavier.multiplier, heavier.averaged_multiplier, 1e-3 * heavier.multiplier);
}

}  // namespace
}  // namespace sonoglide::steady::self_excitation_test
