/// A friction force as the target: what the plant's own account says of the force that is held, with
/// friction that is believed wrong, jumps and drifts.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/scene/laws/lugre.hpp"
#include "host_sim/scene/laws/stribeck.hpp"
#include "host_sim/scene/names.hpp"
#include "tests/common/lugre.hpp"
#include "tests/common/table_1.hpp"

namespace sonoglide::loop::force_target_test {
namespace {

using scene::Arithmetic;
using scene::Scene;

std::vector<Period> periods_of(const Scene& scene, RunResult* result = nullptr) {
  PeriodRecording recording;
  Watch watch;
  watch.periods.push_back(&recording);
  const RunResult run = loop::run(scene, watch);
  if (result != nullptr) {
    *result = run;
  }
  return recording.periods;
}

/// Table 1 as target_step.toml has it.
Scene held_at(double part_of_friction, Arithmetic arithmetic = Arithmetic::float64) {
  Scene scene = tests::table_1_closed_loop(arithmetic);
  scene.run.duration_s = 6e-3;
  scene.controller->target_friction_ratio.clear();
  scene.controller->target_friction_force_N = {{0.0, part_of_friction * scene.friction.limit_N()}};
  return scene;
}

/// As the reader leaves it.
void change_friction(Scene& scene, const scene::TimedProfile& factors) {
  for (const scene::TimedValue& each : factors) {
    scene.friction.coefficient_profile.push_back(
        {each.time_s, each.value * scene.friction.coefficient});
  }
  scene.friction.coefficient = scene.friction.coefficient_profile.front().value;
  scene.sensor.force_full_scale_N = 2.0 * scene.friction.largest_limit_N();
}

/// From a time until the force is within 2 % of the friction at 0 s for good.
double back_after_s(const std::vector<Period>& periods, double target_N, double friction_N,
                    double since_s) {
  double outside_s = since_s;
  for (const Period& period : periods) {
    if (period.end_s > since_s &&
        !(std::abs(period.friction_force_N - target_N) <= 0.02 * friction_N)) {
      outside_s = period.end_s;
    }
  }
  return outside_s - since_s;
}

struct Mean {
  double force_N = 0.0;
  double named = 0.0;  ///< part of the periods with a limit
  control::Limit limit = control::Limit::none;
};

Mean mean_since(const std::vector<Period>& periods, double since_s) {
  Mean mean;
  double count = 0.0;
  for (const Period& period : periods) {
    if (period.begin_s >= since_s && period.whole) {
      mean.force_N += period.friction_force_N;
      mean.named += period.limit == control::Limit::none ? 0.0 : 1.0;
      mean.limit = period.limit == control::Limit::none ? mean.limit : period.limit;
      count += 1.0;
    }
  }
  mean.force_N /= count;
  mean.named /= count;
  return mean;
}

class ForceTargetTest : public testing::TestWithParam<Arithmetic> {};

TEST_P(ForceTargetTest, AJumpOfTheFrictionIsBackWithinHalfAMillisecond) {
  for (const double factor : {1.5, 0.5}) {
    for (const double part : {0.2, 0.3, 0.4}) {
      Scene scene = held_at(part, GetParam());
      const double friction_N = scene.friction.limit_N();
      change_friction(scene, {{0.0, 1.0}, {3e-3, 1.0}, {3e-3, factor}});
      RunResult result;
      const std::vector<Period> periods = periods_of(scene, &result);
      const double target_N = part * friction_N;
      EXPECT_TRUE(result.control->faults.empty());
      EXPECT_LE(back_after_s(periods, target_N, friction_N, 3e-3), 0.5e-3)
          << "jump to " << factor << ", target " << part;
      const Mean mean = mean_since(periods, 5e-3);
      EXPECT_NEAR(mean.force_N, target_N, 2e-3 * friction_N) << factor << " " << part;
      EXPECT_EQ(mean.limit, control::Limit::none) << factor << " " << part;
    }
  }
}

/// The first target too: the believed friction alone is wrong.
TEST_P(ForceTargetTest, AFrictionThatIsBelievedWrongIsMadeGood) {
  for (const double believed : {0.5, 0.7, 1.5, 2.0}) {
    for (const double part : {0.3, 0.6, 0.9}) {
      Scene scene = held_at(part, GetParam());
      scene.model_error.coefficient = believed;
      scene.sensor.force_full_scale_N = 0.08;
      scene.model_error.contact_stiffness = believed < 1.0 ? 1.5 : 0.67;
      RunResult result;
      const std::vector<Period> periods = periods_of(scene, &result);
      const double friction_N = scene.friction.limit_N();
      EXPECT_TRUE(result.control->faults.empty());
      EXPECT_LE(back_after_s(periods, part * friction_N, friction_N, 0.0), 1.5e-3)
          << "believed " << believed << ", target " << part;
      EXPECT_EQ(mean_since(periods, 4e-3).limit, control::Limit::none) << believed << " " << part;
    }
  }
}

/// A body of its own mass under a force that is held: it slows down by F*/M a second; after a jump of
/// the friction too.
TEST_P(ForceTargetTest, ALoadSlowsDownByTheForceOverItsMass) {
  constexpr double part = 0.4;
  for (const double factor : {1.0, 1.5, 0.5}) {
    Scene scene = held_at(part, GetParam());
    const double friction_N = scene.friction.limit_N();
    scene::Load load;
    load.mass_kg = 0.01;
    load.initial_velocity_m_per_s = scene.sliding.fastest_m_per_s();
    scene.load = load;
    scene.run.duration_s = 8e-3;
    change_friction(scene, {{0.0, 1.0}, {3e-3, 1.0}, {3e-3, factor}});
    RunResult result;
    const std::vector<Period> periods = periods_of(scene, &result);
    EXPECT_TRUE(result.control->faults.empty());
    const auto first = std::find_if(periods.begin(), periods.end(),
                                    [](const Period& period) { return period.begin_s >= 4e-3; });
    const double change_m_per_s =
        periods.back().begin_velocity_m_per_s - first->begin_velocity_m_per_s;
    const double target_N = part * friction_N;
    EXPECT_NEAR(change_m_per_s,
                -target_N / load.mass_kg * (periods.back().begin_s - first->begin_s),
                2e-2 * std::abs(change_m_per_s))
        << factor;
    EXPECT_LE(back_after_s(periods, target_N, friction_N, 3e-3), 0.5e-3) << factor;
  }
}

INSTANTIATE_TEST_SUITE_P(Arithmetics, ForceTargetTest,
                         testing::Values(Arithmetic::float64, Arithmetic::float32, Arithmetic::q31,
                                         Arithmetic::q15),
                         [](const auto& instance) {
                           return std::string(scene::name_of(scene::arithmetics, instance.param));
                         });

TEST(ForceTargetLimits, AForceAboveTheFrictionIsNamed) {
  Scene scene = held_at(0.7);
  const double friction_N = scene.friction.limit_N();
  change_friction(scene, {{0.0, 1.0}, {3e-3, 1.0}, {3e-3, 0.5}, {6e-3, 0.5}, {6e-3, 1.0}});
  scene.run.duration_s = 9e-3;
  const std::vector<Period> periods = periods_of(scene);
  double named = 0.0;
  for (const Period& period : periods) {
    named += period.begin_s > 3.5e-3 && period.end_s < 6e-3 && period.limit != control::Limit::none
                 ? period.end_s - period.begin_s
                 : 0.0;
  }
  EXPECT_GT(named, 2.4e-3);
  const auto inside = std::find_if(periods.begin(), periods.end(),
                                   [](const Period& period) { return period.begin_s > 5.9e-3; });
  EXPECT_EQ(inside->limit, control::Limit::ratio_end);
  EXPECT_GT(inside->friction_force_N, 0.9 * 0.5 * friction_N);
  EXPECT_LE(back_after_s(periods, 0.7 * friction_N, friction_N, 6e-3), 0.5e-3);
}

TEST(ForceTargetLimits, AForceBelowWhatFullDriveReachesIsNamed) {
  Scene scene = held_at(0.3);
  scene.drive->max_force_amplitude_N = 400.0;
  const std::vector<Period> periods = periods_of(scene);
  const Mean mean = mean_since(periods, 3e-3);
  EXPECT_EQ(mean.limit, control::Limit::actuator);
  EXPECT_EQ(mean.named, 1.0);
  EXPECT_GT(mean.force_N, 0.35 * scene.friction.limit_N());
}

TEST(ForceTargetLimits, AFrictionThatComesFromACalibrationIsTheFirstRatio) {
  Scene scene = held_at(0.5);
  scene.model_error.coefficient = 0.5;
  scene.controller->friction = scene::FrictionSource::calibrated;
  scene.controller->calibration_s = 1e-3;
  const std::vector<Period> periods = periods_of(scene);
  const double friction_N = scene.friction.limit_N();
  EXPECT_LE(back_after_s(periods, 0.5 * friction_N, friction_N, 1e-3), 0.2e-3);
}

/// Laws whose friction falls with the speed, by a fifth and a tenth at some.
void set_own_values(scene::Friction& friction) {
  if (auto* lugre = std::get_if<scene::laws::LuGre>(&friction.law)) {
    *lugre = tests::damped_lugre(1.2 * friction.coefficient);
  }
  if (auto* stribeck = std::get_if<scene::laws::Stribeck>(&friction.law)) {
    stribeck->fall_s_per_m = 2.0 * friction.coefficient;
    stribeck->rise_s3_per_m3 = 20.0 * friction.coefficient;
  }
}

/// Random contacts and speeds, believed wrong by up to half, that jump or drift.
class RandomForceTest : public testing::TestWithParam<scene::FrictionLaw> {};

TEST_P(RandomForceTest, TheForceIsHeldWhateverTheFriction) {
  constexpr int loops = 40;
  std::mt19937_64 random(36);
  const auto between = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int held = 0;
  for (int i = 0; i < loops; ++i) {
    Scene scene = held_at(1.0);
    scene.friction.law = GetParam();
    scene.friction.coefficient *= between(0.5, 2.0);
    set_own_values(scene.friction);
    if (scene::is_elastic(scene.friction.law)) {
      scene.friction.contact_stiffness_N_per_m *= between(0.7, 2.0);
    } else {
      scene.friction.contact_stiffness_N_per_m = 0.0;
    }
    scene.sliding.profile = {{0.0, between(0.015, 0.04)}};
    scene.model_error.coefficient = 1.0 / between(0.5, 1.5);
    scene.model_error.contact_stiffness = 1.0 / between(0.5, 1.5);
    const double level = between(0.5, 1.5);
    const double begin_s = between(2e-3, 4e-3);
    const double end_s = begin_s + (i % 2 == 0 ? 0.0 : between(1e-3, 4e-3));
    const double friction_N = scene.friction.limit_N();
    change_friction(scene, {{0.0, 1.0}, {begin_s, 1.0}, {end_s, level}});
    scene.sensor.adc_bits = 12;
    scene.run.duration_s = 12e-3;
    scene.solver.tolerance = 1e-6;
    const double undriven_N = scene::undriven_friction_N(
        scene.friction.law, scene.friction, scene.sliding.profile.front().velocity_m_per_s);
    const double target_N = between(0.25, 0.75) * std::min(1.0, level) * undriven_N;
    scene.controller->target_friction_force_N = {{0.0, target_N}};
    RunResult result;
    const std::vector<Period> periods = periods_of(scene, &result);
    EXPECT_TRUE(result.control->faults.empty()) << "loop " << i;
    const Mean mean = mean_since(periods, 10e-3);
    const bool on_target = std::abs(mean.force_N - target_N) < 0.01 * friction_N;
    EXPECT_TRUE(on_target || mean.named > 0.5) << "loop " << i << " silent: " << mean.force_N
                                               << " for " << target_N << " of " << friction_N;
    held += on_target && back_after_s(periods, target_N, friction_N, 10e-3) == 0.0 ? 1 : 0;
  }
  EXPECT_GE(held, loops - 1);
}

INSTANTIATE_TEST_SUITE_P(Laws, RandomForceTest,
                         testing::Values(scene::FrictionLaw(scene::laws::Dahl{}),
                                         scene::FrictionLaw(scene::laws::Coulomb{}),
                                         scene::FrictionLaw(scene::laws::LuGre{}),
                                         scene::FrictionLaw(scene::laws::Stribeck{})),
                         [](const auto& instance) {
                           return std::string(scene::name_of(instance.param));
                         });

/// Every mode of the vibration, as the example scenes have it, after a jump of the friction.
class ForceInModesTest : public testing::TestWithParam<const char*> {};

TEST_P(ForceInModesTest, TheForceIsHeldAfterAJump) {
  for (const double factor : {1.0, 1.4, 0.7}) {
    Scene scene =
        experiment::read_file(std::string(SONOGLIDE_SCENES "/") + GetParam() + ".toml").plant;
    scene.run.record.clear();
    scene.sliding.profile = {{0.0, scene.sliding.fastest_m_per_s()}};
    const double friction_N = scene.friction.limit_N();
    const double target_N = 0.5 * friction_N;
    const double jump_s = 0.4 * scene.run.duration_s;
    scene.controller->target_friction_ratio.clear();
    scene.controller->target_friction_force_N = {{0.0, target_N}};
    change_friction(scene, {{0.0, 1.0}, {jump_s, 1.0}, {jump_s, factor}});
    RunResult result;
    const std::vector<Period> periods = periods_of(scene, &result);
    EXPECT_TRUE(result.control->faults.empty()) << factor;
    const Mean mean = mean_since(periods, 0.8 * scene.run.duration_s);
    EXPECT_NEAR(mean.force_N, target_N, 0.02 * friction_N) << factor;
    EXPECT_LT(mean.named, 0.5) << factor << " " << static_cast<int>(mean.limit);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ForceInModesTest,
                         testing::Values("target_step", "robust_notch", "robust_step",
                                         "damped_step", "damped_by_force", "haptic_plate",
                                         "langevin"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace sonoglide::loop::force_target_test
