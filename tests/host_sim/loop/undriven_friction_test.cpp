#include "host_sim/loop/plant/undriven_friction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/common/constants/table_1_numbers.hpp"
#include "tests/common/lugre.hpp"
#include "tests/common/table_1.hpp"
#include "tests/host_sim/loop/logs/logged_run.hpp"

namespace sonoglide::loop::undriven_friction_test {
namespace {

using scene::Scene;
using tests::period_s;
using tests::pi;
using tests::table_1;
using tests::table_1_closed_loop;

/// mu_s is half as large again.
const scene::laws::LuGre bristles = tests::damped_lugre(0.15);
/// Least friction at 50 mm/s, a quarter below the static one.
const scene::laws::Stribeck curve = {0.75, 100.0};

Scene with_law(Scene scene, const scene::FrictionLaw& law) {
  scene.friction.law = law;
  scene.friction.contact_stiffness_N_per_m =
      scene::is_elastic(law) ? tests::Table1::contact_stiffness_N_per_m : 0.0;
  return scene;
}

EnergyBalance completed(const Scene& scene, const Stretch& stretch) {
  EnergyBalance energy;
  energy.duration_s = stretch.duration_s;
  const double end =
      stretch.sliding_velocity_m_per_s + stretch.sliding_acceleration_m_per_s2 * stretch.duration_s;
  energy.sliding_distance_m =
      0.5 * std::abs(stretch.sliding_velocity_m_per_s + end) * stretch.duration_s;
  UndrivenFriction(scene).complete(stretch, energy);
  return energy;
}

Stretch stretch(double duration_s, double velocity_m_per_s, double acceleration_m_per_s2) {
  Stretch all;
  all.duration_s = duration_s;
  all.sliding_velocity_m_per_s = velocity_m_per_s;
  all.sliding_acceleration_m_per_s2 = acceleration_m_per_s2;
  return all;
}

TEST(UndrivenFrictionTest, IsTheLimitOfALawWithoutACurve) {
  for (const scene::FrictionLaw& law :
       {scene::FrictionLaw(scene::laws::Dahl{}), scene::FrictionLaw(scene::laws::Coulomb{}),
        scene::FrictionLaw(scene::laws::Iwan{2}),
        scene::FrictionLaw(scene::laws::TransverseCoulomb{})}) {
    const EnergyBalance energy = completed(with_law(table_1(), law), stretch(3e-5, 0.01, 700.0));
    EXPECT_EQ(energy.undriven_s, energy.duration_s);
    EXPECT_EQ(energy.limit_distance_m, energy.sliding_distance_m);
  }
}

/// The mean of exp(-(v/v_s)^2) over a ramp is an error function.
TEST(UndrivenFrictionTest, OfBristlesOnARampIsTheErrorFunction) {
  for (const double end_m_per_s : {0.02, 0.05, 0.2}) {
    const double duration_s = 1e-3;
    const EnergyBalance energy = completed(with_law(table_1(), bristles),
                                           stretch(duration_s, 0.0, end_m_per_s / duration_s));
    const double part = end_m_per_s / 0.02;
    const double bell = 0.5 * std::sqrt(pi) * std::erf(part) / part;
    const double mean =
        1.0 + 0.5 * bell + 0.02 * 0.5 * end_m_per_s / tests::Table1::friction_limit_N;
    EXPECT_NEAR(energy.undriven_s / duration_s, mean, 1e-9) << end_m_per_s;
  }
}

TEST(UndrivenFrictionTest, OfACurveIsItsPolynomial) {
  const double duration_s = 1e-3;
  for (const double way : {-1.0, 1.0}) {
    const EnergyBalance energy =
        completed(with_law(table_1(), curve), stretch(duration_s, way * 0.01, way * 50.0));
    // Over 0.01 ... 0.06 m/s.
    const double square = (0.06 * 0.06 - 0.01 * 0.01) / 2.0 / 0.05;
    const double fourth = (std::pow(0.06, 4) - std::pow(0.01, 4)) / 4.0 / 0.05;
    EXPECT_NEAR(energy.undriven_s / duration_s, 1.0 - 7.5 * square + 1000.0 * fourth, 1e-14);
  }
}

TEST(UndrivenFrictionTest, FollowsBothProfiles) {
  Scene scene = with_law(table_1(), scene::laws::Coulomb{});
  scene.friction.coefficient_profile = {{0.0, 0.1}, {2e-3, 0.3}};
  scene.friction.normal_force_profile_N = {{0.0, 4.0}, {2e-3, 2.0}};
  // Fc = (0.1 + 100 t)(4 - 1000 t), over the largest of either; |Vt| = 0.02 + 10 t.
  Stretch late = stretch(1e-3, 0.03, 10.0);
  late.begin_s = 1e-3;
  const EnergyBalance energy = completed(scene, late);
  const auto antiderivative = [](double t) {
    return 0.4 * t + 300.0 * t * t / 2.0 - 1e5 * t * t * t / 3.0;
  };
  EXPECT_NEAR(energy.undriven_s, (antiderivative(2e-3) - antiderivative(1e-3)) / 1.2, 1e-16);
  const auto work = [](double t) {
    return 0.008 * t + (4.0 + 6.0) * t * t / 2.0 + (3000.0 - 2000.0) * t * t * t / 3.0 -
           1e6 * t * t * t * t / 4.0;
  };
  EXPECT_NEAR(energy.limit_distance_m, (work(2e-3) - work(1e-3)) / 1.2, 1e-17);
}

/// Sliding undriven is a friction ratio of 1, at any speed.
TEST(UndrivenFrictionTest, AContactWithoutVibrationIsAtOne) {
  for (const scene::FrictionLaw& law : {scene::FrictionLaw(bristles), scene::FrictionLaw(curve)}) {
    for (const double speed_m_per_s : {0.005, -0.0267, 0.08}) {
      Scene scene = with_law(table_1(0.0), law);
      scene.sliding.profile = {{0.0, speed_m_per_s}};
      // Settled, a mass on a spring under a force that depends on its speed.
      scene.plant.damping_N_s_per_m = 3000.0;
      scene.run.duration_s = 400.0 * period_s;
      scene.run.window_start_s = 350.0 * period_s;
      EXPECT_NEAR(power_ratios(scene, run(scene).window).friction_ratio, 1.0, 1e-6)
          << scene::name_of(law) << " at " << speed_m_per_s;
    }
  }
}

/// What the figure says is the mean of the recorded force over the law's own formula.
double recorded_ratio(const LoggedRun& logged, double from_s, double undriven_N) {
  double sum_N = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < logged.trace.time_s.size(); ++i) {
    if (logged.trace.time_s[i] >= from_s) {
      sum_N += logged.trace.state[i].friction_force_N;
      ++count;
    }
  }
  return sum_N / static_cast<double>(count) / undriven_N;
}

struct Formula {
  scene::FrictionLaw law;
  double undriven_N;
};

TEST(UndrivenFrictionTest, AClosedLoopOnTargetIsShownOnIt) {
  constexpr double v = 0.02672;
  constexpr double normal_N = tests::Table1::normal_force_N;
  const Formula formulas[] = {
      {bristles, normal_N * (0.1 + 0.05 * std::exp(-v * v / 0.0004)) + 0.02 * v},
      {curve, normal_N * (0.1 - 0.75 * v + 100.0 * v * v * v)}};
  for (const Formula& formula : formulas) {
    for (const double target : {0.4, 0.6, 0.8}) {
      for (const double calibration_s : {0.0, 1e-3}) {
        Scene scene = with_law(table_1_closed_loop(), formula.law);
        scene.controller->target_friction_ratio = {{0.0, target}};
        scene.controller->calibration_s = calibration_s;
        scene.run.duration_s = 6e-3;
        scene.run.record = {scene::Channel::friction_force};
        scene.run.record_interval_s = period_s / 487.3;  // on ever other phases
        const LoggedRun logged = run_logged(scene);
        double mean = 0.0;
        for (std::size_t i = 0; i < 60; ++i) {
          mean += logged.periods[logged.periods.size() - 60 + i].friction_ratio / 60.0;
        }
        EXPECT_NEAR(mean, target, 1e-3) << scene::name_of(formula.law) << " " << calibration_s;
        EXPECT_NEAR(recorded_ratio(logged, 5e-3, formula.undriven_N), mean, 1e-3)
            << scene::name_of(formula.law) << " " << target;
      }
    }
  }
}

}  // namespace
}  // namespace sonoglide::loop::undriven_friction_test
