#include "host_sim/studies/design/study.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/loop/plant/failure.hpp"
#include "tests/host_sim/loop/steady/scenes/steady_scenes.hpp"

namespace sonoglide::design::study_test {
namespace {

using steady::heavy_contact;
using steady::table_1;

Task task_of(const scene::Scene& scene, const std::vector<double>& ratios,
             const std::optional<SpeedRange>& speeds) {
  return make_task(configure::make_experiment(scene), ratios, speeds);
}

void expect_denied(const scene::Scene& scene, const std::string& key) {
  try {
    task_of(scene, {}, {});
    FAIL() << key;
  } catch (const configure::ConfigurationError& error) {
    EXPECT_EQ(error.key(), key);
  }
}

TEST(MakeTaskTest, TakesRatiosAndSpeedsOfTheScene) {
  const Task task = task_of(table_1(), {}, {});
  EXPECT_EQ(task.ratios, (std::vector<double>{0.3, 0.5, 0.7}));
  EXPECT_EQ(task.speeds.slowest_m_per_s, 0.02672);
  EXPECT_EQ(task.speeds.fastest_m_per_s, 0.02672);
  EXPECT_EQ(task_of(table_1(), {0.6, 0.2, 0.6}, {}).ratios, (std::vector<double>{0.2, 0.6}));
  EXPECT_EQ(task_of(table_1(), {}, SpeedRange{0.01, 0.1}).speeds.fastest_m_per_s, 0.1);
}

TEST(MakeTaskTest, DeniesTargetsThatNoCurveOfForceHas) {
  for (const double ratio : {1.0, 1e-9}) {
    scene::Scene scene = table_1();
    scene.controller->target_friction_ratio = {{0.0, ratio}};
    expect_denied(scene, "controller.target_friction_ratio");
    scene.controller->target_friction_ratio.push_back({1e-3, 0.5});
    EXPECT_EQ(task_of(scene, {}, {}).ratios.size(), 2U);
  }
}

TEST(MakeTaskTest, LeavesOutWhatIsSlowerThanTheSpeedFloor) {
  scene::Scene scene = table_1();
  scene.sliding.profile = {{0.0, 0.03}, {1e-3, -0.02}};
  const Task reversing = task_of(scene, {}, {});
  EXPECT_EQ(reversing.speeds.fastest_m_per_s, 0.03);
  EXPECT_EQ(reversing.speeds.slowest_m_per_s, reversing.speed_floor_m_per_s);
  scene.sliding.profile = {{0.0, -0.03}, {1e-3, -0.02}};
  EXPECT_EQ(task_of(scene, {}, {}).speeds.slowest_m_per_s, 0.02);
}

TEST(MakeTaskTest, DeniesWhatHasNoSteadyVibration) {
  scene::Scene scene = table_1();
  scene.controller.reset();
  expect_denied(scene, "controller");
  scene = table_1();
  scene.friction.sign_convention = scene::SignConvention::as_printed;
  expect_denied(scene, "friction.sign_convention");
  scene = table_1();
  scene.drive->waveform = scene::Waveform::square;
  expect_denied(scene, "drive.waveform");
  scene = table_1();
  scene.sliding.profile = {{0.0, 0.0}};
  expect_denied(scene, "sliding.velocity_m_per_s");
}

TEST(DesignStudyTest, HasEveryRatioAtBothEndsOfTheSpeeds) {
  double told = 0.0;
  const DesignStudy found = study(task_of(table_1(), {0.3, 0.7}, SpeedRange{0.01, 0.1}),
                                  [&](double fraction) { told = fraction; });
  EXPECT_EQ(told, 1.0);
  ASSERT_EQ(found.points.size(), 4U);
  EXPECT_EQ(found.points[0].requirement.sliding_m_per_s, 0.01);
  EXPECT_EQ(found.points[0].requirement.ratio, 0.3);
  EXPECT_EQ(found.points[3].requirement.sliding_m_per_s, 0.1);
  EXPECT_EQ(found.points[3].requirement.ratio, 0.7);
  EXPECT_EQ(found.points[3].sensitivities.size(), 8U);
  ASSERT_EQ(found.curves.size(), 2U);
  for (const RatioRequirements& curve : found.curves) {
    EXPECT_TRUE(std::is_sorted(curve.requirements.begin(), curve.requirements.end(),
                               [](const steady::Requirement& a, const steady::Requirement& b) {
                                 return a.motion.drive_force_N < b.motion.drive_force_N;
                               }));
  }
  EXPECT_EQ(found.detunings.size(), 2U);
}

TEST(DesignStudyTest, OfASingleSpeedShowsADecadeToEitherSide) {
  const DesignStudy found = study(task_of(table_1(), {0.5}, {}), [](double) {});
  ASSERT_EQ(found.points.size(), 1U);
  EXPECT_NEAR(found.curves[0].requirements.front().sliding_m_per_s, 0.002672, 1e-12);
  EXPECT_NEAR(found.curves[0].requirements.back().sliding_m_per_s, 0.2672, 1e-10);
  EXPECT_GT(found.curves[0].fastest_m_per_s, 0.1);
}

// A transverse vibration lowers the friction of a sliding that is faster than itself. The controller
// does not drive there.
TEST(DesignStudyTest, NamesAVelocityBeyondTheControllers) {
  const scene::Scene scene = steady::transverse();
  const Task task = task_of(scene, {0.9}, {});
  const double full_m_per_s = task.full_scale_m_per_s;
  const auto found_at = [&](double fastest_m_per_s) {
    return study(task_of(scene, {0.9}, SpeedRange{0.5 * full_m_per_s, fastest_m_per_s}),
                 [](double) {});
  };
  const DesignStudy within = found_at(0.999 * full_m_per_s);
  EXPECT_EQ(within.points.back().requirement.limit, steady::Obstacle::none);
  EXPECT_EQ(within.curves[0].fastest_m_per_s, full_m_per_s);
  const DesignStudy beyond = found_at(full_m_per_s);
  const steady::Requirement& fastest = beyond.points.back().requirement;
  EXPECT_EQ(fastest.limit, steady::Obstacle::velocity_at_rail);
  EXPECT_EQ(fastest.reachable_ratio, 1.0);
  EXPECT_LT(fastest.motion.drive_force_N, scene.max_drive_force_N());
  EXPECT_EQ(beyond.points.front().requirement.limit, steady::Obstacle::none);
}

// A row, and not the end of the study.
TEST(DesignStudyTest, GoesOnWhereAnOrbitRepels) {
  const DesignStudy found = study(task_of(heavy_contact(2000.0), {0.9}, {}), [](double) {});
  ASSERT_EQ(found.points.size(), 1U);
  EXPECT_EQ(found.points[0].requirement.limit, steady::Obstacle::unstable);
}

TEST(DesignStudyTest, FailsWhereNothingCanBeSaid) {
  scene::Scene free = table_1();
  free.plant.stiffness_N_per_m = 0.0;
  EXPECT_THROW(study(task_of(free, {}, {}), [](double) {}), loop::ComputationError);
}

}  // namespace
}  // namespace sonoglide::design::study_test
