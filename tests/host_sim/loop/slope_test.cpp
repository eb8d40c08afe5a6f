/// Friction and springs that change along slopes, against their equations in SI units by
/// Boost.odeint.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/run.hpp"
#include "tests/host_sim/loop/equations/by_peer.hpp"
#include "tests/host_sim/loop/random/random_scene.hpp"

namespace sonoglide::loop::slope_test {
namespace {

using scene::Scene;
using scene::TimedProfile;
using tests::Dice;
using tests::two_pi;

/// Of the motion, in its size, of the last force, in Fc, and of the friction ratio; in tolerances.
struct Errors {
  double motion;
  double force;
  double ratio;
};

Errors errors(Scene scene, const equations::Motion& expected, double tolerance) {
  scene.solver.tolerance = tolerance;
  const RunResult found = run(scene);
  const double omega = two_pi * scene.drive->frequency_Hz;
  const double size_m_per_s = configure::plant_scales(scene).velocity_m_per_s() * tolerance;
  const double limit_N = scene.friction.largest_limit_N() * tolerance;
  return {std::max(std::abs(found.final_state.displacement_m - expected.displacement_m) * omega,
                   std::abs(found.final_state.velocity_m_per_s - expected.velocity_m_per_s)) /
              size_m_per_s,
          std::abs(found.final_state.friction_force_N - expected.friction_force_N) / limit_N,
          std::abs(found.whole.resistance_impulse_N_s - expected.impulse_N_s) /
              (limit_N * scene.run.duration_s)};
}

TimedProfile random_slopes(Dice& dice, double value, double deepest, double duration_s) {
  const auto part = [&] { return value * dice.between(deepest, 1.0); };
  TimedProfile profile = {{0.0, part()}};
  while (profile.back().time_s < duration_s) {
    const double time_s = profile.back().time_s + duration_s * dice.between(0.1, 0.8);
    profile.push_back({time_s, part()});
  }
  return profile;
}

constexpr int scene_count = 6;
constexpr int periods = 8;

Scene with_sloping_friction(Dice& dice, Scene scene) {
  scene::Friction& friction = scene.friction;
  const double choice = dice.between(0.0, 1.0);
  if (choice < 0.6) {
    friction.coefficient_profile =
        random_slopes(dice, friction.coefficient, 0.5, scene.run.duration_s);
    friction.coefficient = friction.coefficient_profile.front().value;
  }
  if (choice > 0.4) {
    friction.normal_force_profile_N =
        random_slopes(dice, friction.normal_force_N, 0.5, scene.run.duration_s);
    friction.normal_force_N = friction.normal_force_profile_N.front().value;
  }
  return scene;
}

Scene with_sloping_spring(Dice& dice, Scene scene) {
  scene::Plant& plant = scene.plant;
  plant.stiffness_profile = random_slopes(dice, plant.stiffness_N_per_m, 0.9, scene.run.duration_s);
  plant.stiffness_N_per_m = plant.stiffness_profile.front().value;
  return scene;
}

using Slope = Scene (*)(Dice&, Scene);

class SlopeTest : public testing::TestWithParam<scene::FrictionLaw> {
 protected:
  /// As documented of a solver in which nothing changes: 19 in 20 within the tolerance, the worst
  /// within ten.
  static void expect_tolerance(Slope slope) {
    std::vector<double> all;
    Dice dice(31);
    for (int i = 0; i < scene_count; ++i) {
      const Scene scene =
          slope(dice, tests::random_scene(dice, GetParam(), dice.chance(0.8), periods));
      const equations::Motion expected = equations::by_peer(scene);
      for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
        const Errors found = errors(scene, expected, tolerance);
        all.insert(all.end(), {found.motion, found.force, found.ratio});
        EXPECT_LE(all.back(), 10.0) << "scene " << i << " at " << tolerance;
      }
    }
    std::sort(all.begin(), all.end());
    EXPECT_LE(all[all.size() * 19 / 20], 1.0);
    EXPECT_LE(all.back(), 50.0);
  }
};

TEST_P(SlopeTest, OfTheFrictionKeepsTheTolerance) {
  expect_tolerance(with_sloping_friction);
}

TEST_P(SlopeTest, OfTheSpringKeepsTheTolerance) {
  expect_tolerance(with_sloping_spring);
}

std::vector<scene::FrictionLaw> laws_with_a_ratio() {
  std::vector<scene::FrictionLaw> laws(scene::every_law.begin(), scene::every_law.end());
  laws.erase(std::remove_if(laws.begin(), laws.end(), scene::is<scene::laws::None>), laws.end());
  return laws;
}

INSTANTIATE_TEST_SUITE_P(Laws, SlopeTest, testing::ValuesIn(laws_with_a_ratio()),
                         [](const auto& tested) {
                           return std::string(scene::name_of(tested.param));
                         });

/// Table 1 with eight springs and a coefficient from 0.05 to 0.1 in 1 ms.
Scene sloping_table_1(const scene::FrictionLaw& law) {
  Scene scene;
  scene.drive.emplace();
  scene.drive->frequency_Hz = 60e3;
  scene.drive->force_amplitude_N = 384.0;
  scene.plant.mass_kg = 0.02;
  scene.plant.stiffness_N_per_m = 133e6;
  scene.friction.law = law;
  scene.friction.coefficient_profile = {{0.0, 0.05}, {1e-3, 0.1}};
  scene.friction.coefficient = 0.05;
  scene.friction.normal_force_N = 0.02 * 9.81;
  scene.friction.contact_stiffness_N_per_m = 0.3e6;
  scene.sliding.profile = {{0.0, 0.0267}};
  scene.run.duration_s = 1e-3;
  return scene;
}

/// 0.555225739 was computed outside this project.
TEST(SlopeOfTable1Test, HasTheKnownRatio) {
  const Scene scene = sloping_table_1(scene::laws::Iwan{8});
  const double undriven_N_s = 0.075 * 0.02 * 9.81 * 1e-3;
  EXPECT_NEAR(run(scene).whole.resistance_impulse_N_s / undriven_N_s, 0.555225739, 1e-9);
  EXPECT_NEAR(equations::by_peer(scene).impulse_N_s / undriven_N_s, 0.555225739, 1e-9);
}

/// Whatever is left of a quarter of a carrier period by rounding.
TEST(SlopeOfTable1Test, EndsAtAnyCarrierFrequency) {
  const std::vector<scene::FrictionLaw> laws = {scene::laws::Dahl{},
                                                scene::laws::LuGre{0.1, 0.01, 0.0, 0.0},
                                                scene::laws::Iwan{8},
                                                scene::laws::Coulomb{},
                                                scene::laws::Stribeck{0.02, 0.1},
                                                scene::laws::TransverseCoulomb{},
                                                scene::laws::NormalCoulomb{1e6}};
  for (const scene::FrictionLaw& law : laws) {
    SCOPED_TRACE(scene::name_of(law));
    for (const double frequency_Hz : {20e3, 50e3, 50.1e3, 50.3e3, 60e3}) {
      Scene scene = sloping_table_1(law);
      scene.drive->frequency_Hz = frequency_Hz;
      scene.sliding.profile = {{0.0, 0.6}};
      scene.run.duration_s = 2e-4;
      const RunResult found = run(scene);
      const PowerRatios ratios = power_ratios(scene, found.whole);
      EXPECT_TRUE(std::isfinite(found.final_state.friction_force_N)) << frequency_Hz;
      EXPECT_LT(std::abs(ratios.balance_residual), 1e-6) << frequency_Hz;
    }
  }
}

/// The contact slips along its limit throughout.
TEST(SlopeOfTable1Test, EndsAtTheForceOfItsEnd) {
  Scene scene = sloping_table_1(scene::laws::Iwan{8});
  scene.sliding.profile = {{0.0, 0.2}};  // faster than the vibration
  for (const double duration_s : {0.5e-3, 0.503e-3, 0.5061e-3}) {
    scene.run.duration_s = duration_s;
    const double limit_N = (0.05 + 50.0 * duration_s) * 0.02 * 9.81;
    EXPECT_NEAR(run(scene).final_state.friction_force_N, limit_N, 1e-12 * limit_N);
  }
}

}  // namespace
}  // namespace sonoglide::loop::slope_test
