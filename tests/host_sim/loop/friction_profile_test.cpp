/// A friction limit that changes while a scene runs: against an integrator of other origin, in its
/// bounds and in its energy.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/plant/changing_plant.hpp"
#include "host_sim/scene/solver_facts.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "tests/common/lugre.hpp"
#include "tests/common/table_1.hpp"
#include "tests/host_sim/loop/equations/by_peer.hpp"
#include "tests/host_sim/loop/logs/logged_run.hpp"

namespace sonoglide::loop::friction_profile_test {
namespace {

using scene::Scene;
using scene::TimedProfile;
using tests::carrier_Hz;
using tests::period_s;
using tests::pi;
using tests::table_1;
using tests::table_1_closed_loop;
using tests::vibration_velocity_m_per_s;

/// Friction that bends the motion, on a scene of ten carrier periods.
Scene heavy(const scene::FrictionLaw& law) {
  Scene scene = table_1();
  scene.friction.law = law;
  scene.friction.normal_force_N = 300.0;
  scene.friction.contact_stiffness_N_per_m = scene::is_elastic(law) ? 4e7 : 0.0;
  scene.plant.damping_N_s_per_m = 20.0;
  scene.solver.tolerance = 1e-12;
  scene.run.duration_s = 10.0 * period_s;
  scene.run.window_start_s = 0.0;
  return scene;
}

/// As the reader leaves it.
Scene with_coefficient(Scene scene, const TimedProfile& profile) {
  scene.friction.coefficient_profile = profile;
  scene.friction.coefficient = scene::value_at(profile, 0.0);
  return scene;
}
Scene with_normal_force(Scene scene, const TimedProfile& profile) {
  scene.friction.normal_force_profile_N = profile;
  scene.friction.normal_force_N = scene::value_at(profile, 0.0);
  return scene;
}

/// In parts of the vibration, and of the largest limit.
void expect_peers_motion(const Scene& scene, double allowed) {
  const equations::Motion expected = equations::by_peer(scene);
  const RunResult result = run_logged(scene).result;
  const double velocity = vibration_velocity_m_per_s(scene.plant, 384.0);
  const double limit_N = scene.friction.largest_limit_N();
  EXPECT_NEAR(result.final_state.displacement_m, expected.displacement_m,
              allowed * velocity / (2.0 * pi * carrier_Hz));
  EXPECT_NEAR(result.final_state.velocity_m_per_s, expected.velocity_m_per_s, allowed * velocity);
  EXPECT_NEAR(result.whole.friction_impulse_N_s, expected.impulse_N_s,
              allowed * limit_N * scene.run.duration_s);
}

const TimedProfile jumps = {{0.0, 0.1},
                            {2.3 * period_s, 0.1},
                            {2.3 * period_s, 0.25},
                            {6.6 * period_s, 0.25},
                            {6.6 * period_s, 0.06}};
const TimedProfile slopes = {{1.0 * period_s, 0.1}, {4.5 * period_s, 0.3}, {8.0 * period_s, 0.05}};
const TimedProfile normal_slopes = {
    {0.0, 300.0}, {7.0 * period_s, 120.0}, {10.0 * period_s, 400.0}};

TEST(FrictionProfileTest, JumpsAreThePeers) {
  expect_peers_motion(with_coefficient(heavy(scene::laws::Dahl{}), jumps), 1e-8);
  expect_peers_motion(with_coefficient(heavy(scene::laws::Coulomb{}), jumps), 1e-8);
}

TEST(FrictionProfileTest, SlopesAreThePeers) {
  constexpr double allowed = 1e-9;
  for (const scene::FrictionLaw& law :
       {scene::FrictionLaw(scene::laws::Dahl{}), scene::FrictionLaw(scene::laws::Coulomb{})}) {
    expect_peers_motion(with_coefficient(heavy(law), slopes), allowed);
    expect_peers_motion(with_normal_force(heavy(law), normal_slopes), allowed);
    expect_peers_motion(with_normal_force(with_coefficient(heavy(law), slopes), normal_slopes),
                        allowed);
  }
}

TEST(FrictionProfileTest, AShortSlopeIsThePeers) {
  const TimedProfile steep = {{3.1 * period_s, 0.1}, {3.4 * period_s, 0.3}};
  expect_peers_motion(with_coefficient(heavy(scene::laws::Dahl{}), steep), 1e-8);
}

Scene recorded(Scene scene) {
  scene.run.record = {scene::Channel::friction_force};
  scene.run.record_interval_s = period_s / 64.0;
  return scene;
}

const std::vector<scene::FrictionLaw>& laws() {
  static const std::vector<scene::FrictionLaw> all = {scene::laws::Dahl{},
                                                      tests::damped_lugre(0.4),
                                                      scene::laws::Iwan{3},
                                                      scene::laws::Coulomb{},
                                                      scene::laws::Stribeck{0.3, 30.0},
                                                      scene::laws::TransverseCoulomb{},
                                                      scene::laws::NormalCoulomb{1e8}};
  return all;
}

std::vector<scene::FrictionLaw> bounded_laws() {
  std::vector<scene::FrictionLaw> found;
  std::copy_if(laws().begin(), laws().end(), std::back_inserter(found), scene::is_bounded);
  return found;
}

TEST(FrictionProfileTest, NoLawPassesItsLimit) {
  ASSERT_EQ(bounded_laws().size(), 4U) << "Dahl, Iwan and Coulomb along and across";
  for (const scene::FrictionLaw& law : bounded_laws()) {
    for (const TimedProfile& profile : {jumps, slopes}) {
      const Scene scene = recorded(with_coefficient(heavy(law), profile));
      const LoggedRun logged = run_logged(scene);
      ASSERT_EQ(logged.trace.state.size(), 641U);
      for (std::size_t i = 0; i < logged.trace.state.size(); ++i) {
        const double limit_N =
            configure::contact_at(scene.friction, logged.trace.time_s[i]).limit_N();
        EXPECT_LE(std::abs(logged.trace.state[i].friction_force_N), limit_N * (1.0 + 1e-12))
            << scene::name_of(law) << " at " << logged.trace.time_s[i];
      }
      EXPECT_LE(
          std::abs(logged.result.final_state.friction_force_N),
          configure::contact_at(scene.friction, scene.run.duration_s).limit_N() * (1.0 + 1e-12));
    }
  }
}

TEST(FrictionProfileTest, EnergyIdentityHoldsAcrossChanges) {
  for (const scene::FrictionLaw& law : laws()) {
    for (const TimedProfile& profile : {jumps, slopes}) {
      const Scene scene = with_normal_force(with_coefficient(heavy(law), profile), normal_slopes);
      EXPECT_LE(power_ratios(scene, run_logged(scene).result.whole).balance_residual, 1e-9)
          << scene::name_of(law);
    }
  }
}

/// Every solver that takes the law.
TEST(FrictionProfileTest, EverySolverFollows) {
  const TimedProfile vanishing = {
      {0.0, 0.0}, {period_s, 0.0}, {period_s, 0.1}, {4.0 * period_s, 0.1}, {4.0 * period_s, 0.0}};
  for (const auto& [profile, bound] : {std::pair(slopes, 1e-7), std::pair(vanishing, 1e-6)}) {
    const Scene reference = with_coefficient(heavy(scene::laws::Dahl{}), profile);
    const double impulse_N_s = run_logged(reference).result.whole.friction_impulse_N_s;
    for (const auto& method : scene::solver_methods) {
      Scene scene = reference;
      scene.solver.method = method.value;
      const bool adaptive = scene::is_adaptive(method.value);
      scene.solver.tolerance = 1e-6;
      scene.solver.step_s = adaptive ? 0.0 : period_s / 4000.0;
      EXPECT_NEAR(run_logged(scene).result.whole.friction_impulse_N_s, impulse_N_s,
                  bound * std::abs(impulse_N_s))
          << method.name;
    }
  }
}

/// A profile that says what a number says is that number, bit for bit.
TEST(FrictionProfileTest, WithoutAChangeIsTheSceneWithoutIt) {
  const auto law = scene::laws::Dahl{};
  const Scene plain = heavy(law);
  const Scene profiled = with_normal_force(with_coefficient(plain, {{0.0, 0.1}}), {{0.0, 300.0}});
  const RunResult one = run_logged(plain).result;
  const RunResult other = run_logged(profiled).result;
  EXPECT_EQ(one.final_state.displacement_m, other.final_state.displacement_m);
  EXPECT_EQ(one.final_state.friction_force_N, other.final_state.friction_force_N);
  EXPECT_EQ(one.solver_steps, other.solver_steps);
}

/// The force on a spring does not know of a limit above it, and is cut to one below it.
TEST(FrictionProfileTest, TheForceGoesOverInNewtons) {
  for (const scene::FrictionLaw& law :
       {scene::FrictionLaw(scene::laws::Dahl{}), scene::FrictionLaw(scene::laws::Iwan{4})}) {
    // No drive, a wall of a spring, a slide that has long reached the limit.
    Scene scene = table_1();
    scene.drive.reset();
    scene.plant.stiffness_N_per_m = 1e15;
    scene.friction.law = law;
    scene.sliding.profile = {{0.0, 0.02}};
    scene.run.duration_s = 1e-3;
    scene.run.window_start_s = 0.0;
    scene.run.record = {scene::Channel::friction_force};
    scene.run.record_interval_s = 1e-6;
    const auto force_N = [&](const TimedProfile& profile, std::size_t microseconds) {
      return run_logged(with_coefficient(scene, profile))
          .trace.state.at(microseconds)
          .friction_force_N;
    };
    const TimedProfile up = {{0.5e-3, 0.1}, {0.5e-3, 0.2}};
    const TimedProfile down = {{0.5e-3, 0.1}, {0.5e-3, 0.05}};
    EXPECT_NEAR(force_N(up, 499), 0.01962, 1e-8);
    EXPECT_NEAR(force_N(up, 500), 0.01962, 1e-8);
    EXPECT_NEAR(force_N(up, 999), 0.03924, 1e-6);
    EXPECT_NEAR(force_N(down, 499), 0.01962, 1e-8);
    EXPECT_NEAR(force_N(down, 500), 0.00981, 1e-12);
    EXPECT_NEAR(force_N(down, 999), 0.00981, 1e-12);
  }
}

/// Bristles that have more of a static friction than of a sliding one keep to their own bound.
TEST(FrictionProfileTest, BristlesFollowTheNormalForce) {
  Scene scene = heavy(tests::bare_lugre(0.2, 1e-3));
  scene.drive.reset();
  scene.plant.stiffness_N_per_m = 1e15;
  scene.friction.normal_force_N = 10.0;
  scene.sliding.profile = {{0.0, 1.0}};
  scene.run.duration_s = 1e-4;
  const Scene moved = with_normal_force(scene, {{5e-5, 10.0}, {5e-5, 30.0}});
  EXPECT_NEAR(run_logged(moved).result.final_state.friction_force_N, 3.0, 1e-9);
}

TEST(FrictionProfileTest, FrictionMayVanishAndComeBack) {
  for (const scene::FrictionLaw& law : bounded_laws()) {
    const TimedProfile gone = {
        {2.0 * period_s, 0.1}, {3.0 * period_s, 0.0}, {5.0 * period_s, 0.0}, {6.0 * period_s, 0.1}};
    const LoggedRun logged = run_logged(with_coefficient(heavy(law), gone));
    ASSERT_EQ(logged.periods.size(), 10U);
    EXPECT_TRUE(std::isnan(logged.periods[3].friction_ratio)) << scene::name_of(law);
    EXPECT_TRUE(std::isnan(logged.periods[4].friction_ratio)) << scene::name_of(law);
    EXPECT_GT(logged.periods[8].friction_ratio, 0.05) << scene::name_of(law);
    EXPECT_LT(logged.periods[8].friction_ratio, 1.0) << scene::name_of(law);
  }
}

/// Without feedback of it the drive stays: half the ratio for twice the friction. A controller that
/// trusts its scene holds the force.
TEST(FrictionProfileTest, AControllerThatTrustsTheSceneHoldsTheForce) {
  Scene scene = table_1_closed_loop();
  scene.controller->target_friction_ratio = {{0.0, 0.4}};
  scene.run.duration_s = 4e-3;
  for (const double factor : {0.5, 2.0}) {
    const Scene moved = with_coefficient(scene, {{1e-3, 0.1}, {1e-3, 0.1 * factor}});
    EXPECT_NEAR(run_logged(moved).periods.back().friction_ratio, 0.4 / factor, 2e-3);
  }
}

TEST(FrictionProfileTest, AClosedLoopWithoutAChangeKeepsItsTrace) {
  const Scene scene = table_1_closed_loop(scene::Arithmetic::q31);
  const Scene profiled = with_coefficient(scene, {{0.0, 0.1}});
  EXPECT_EQ(run_logged(scene).result.control->trace_hash,
            run_logged(profiled).result.control->trace_hash);
}

}  // namespace
}  // namespace sonoglide::loop::friction_profile_test
