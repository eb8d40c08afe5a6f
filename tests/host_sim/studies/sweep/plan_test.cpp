#include "host_sim/studies/sweep/plan.hpp"
#include "host_sim/configure/read/experiment.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <complex>
#include <string>
#include <vector>

#include "host_sim/scene_file/echo.hpp"
#include "tests/common/constants/table_1_numbers.hpp"
#include "tests/host_sim/studies/sweep/scenes/base_scenes.hpp"
#include "tests/host_sim/studies/sweep/scenes/scratch_scene.hpp"

namespace sonoglide::sweep::plan_test {
namespace {

using Texts = std::vector<std::string>;

/// What the plan, or else the first bad point, is refused for; the folder's name left out.
std::string error_of(const std::string& text, const Texts& vary, const Texts& overrides = {}) {
  const ScratchScene scratch(text);
  try {
    const Plan plan(scene_file::read_source(scratch.file()), overrides, vary);
    plan.visit(plan.all(), [](std::size_t, const experiment::Experiment&) {});
  } catch (const scene_file::SceneError& error) {
    std::string what = error.what();
    const std::string folder = scratch.folder().string() + "/";
    const std::size_t at = what.find(folder);
    return at == std::string::npos ? what : what.erase(at, folder.size());
  }
  return "no error";
}

TEST(PlanTest, APointIsTheSceneWithItsKeysSet) {
  const ScratchScene scratch(open_loop);
  const Plan plan(scene_file::read_source(scratch.file()), {"solver.tolerance=1e-8"},
                  {"drive.force_amplitude_N=100:300:3", "friction.coefficient=0.1:0.2:2"});
  const scene::Scene expected =
      experiment::read_file(scratch.file(), {"solver.tolerance=1e-8", "drive.force_amplitude_N=200",
                                             "friction.coefficient=0.2"})
          .nominal;
  EXPECT_EQ(scene_file::to_json(plan.experiment(3).nominal), scene_file::to_json(expected));
  EXPECT_EQ(plan.describe(3), "drive.force_amplitude_N=200, friction.coefficient=0.2");
}

TEST(PlanTest, TakesIntegerKeys) {
  const ScratchScene scratch(closed_loop);
  const Plan plan(scene_file::read_source(scratch.file()), {},
                  {"sensor.adc_bits=8:12:3", "sensor.seed=1:2:2"});
  EXPECT_EQ(plan.experiment(5).plant.sensor.adc_bits, 12);
  EXPECT_EQ(plan.experiment(5).plant.sensor.seed, 2U);
}

TEST(PlanTest, EveryPointIsTheSceneThatItsOptionsGive) {
  const ScratchScene scratch(open_loop);
  const Plan plan(
      scene_file::read_source(scratch.file()), {"solver.tolerance=1e-8"},
      {"friction.contact_stiffness_N_per_m=1:1e17:35:log", "sliding.velocity_m_per_s=-0.1:0.2:7"});
  plan.visit(plan.all(), [&](std::size_t point, const experiment::Experiment& experiment) {
    const auto option = [&](const char* key, std::size_t axis) {
      return key + ('=' + plan.grid().text(point, axis));
    };
    const scene::Scene expected =
        experiment::read_file(scratch.file(), {"solver.tolerance=1e-8",
                                               option("friction.contact_stiffness_N_per_m", 0),
                                               option("sliding.velocity_m_per_s", 1)})
            .nominal;
    EXPECT_EQ(scene_file::to_json(experiment.nominal), scene_file::to_json(expected))
        << plan.describe(point);
  });
}

TEST(PlanTest, ReadingTellsOfItsProgress) {
  const ScratchScene scratch(open_loop);
  const Plan plan(scene_file::read_source(scratch.file()), {},
                  {"friction.coefficient=0.1:0.2:5000"});
  std::vector<double> fractions;
  const long_work::Progress progress = [&](double fraction) { fractions.push_back(fraction); };
  long_work::Pace pace(progress);
  pace.begin(plan.grid().size(), 0.0);
  plan.visit(
      plan.all(), [](std::size_t, const experiment::Experiment&) {}, &pace);
  EXPECT_GE(fractions.size(), 5U);
  EXPECT_EQ(fractions.back(), 1.0);
}

TEST(PlanTest, VisitsThePointsOfARangeAndNoOther) {
  const ScratchScene scratch(open_loop);
  const Plan plan(scene_file::read_source(scratch.file()), {},
                  {"friction.coefficient=99:101:1000000000"}, most_points_in_shards);
  std::atomic<std::size_t> visits{0};
  const auto visit = [&](std::size_t point, const experiment::Experiment&) {
    EXPECT_GE(point, 1000U);
    EXPECT_LT(point, 3000U);
    ++visits;
  };
  plan.visit({1000, 3000}, visit);
  EXPECT_EQ(visits, 2000U);
  EXPECT_THROW(
      plan.visit({499'999'999, 500'000'001}, [](std::size_t, const experiment::Experiment&) {}),
      scene_file::SceneError);
}

TEST(PlanTest, RecordsNothing) {
  const ScratchScene scratch(open_loop +
                             "record = [\"displacement_m\"]\nrecord_interval_s = 1e-6\n");
  const Plan plan(scene_file::read_source(scratch.file()), {}, {"friction.coefficient=0.1:0.2:2"});
  EXPECT_TRUE(plan.experiment(1).plant.run.record.empty());
}

TEST(PlanTest, TheSceneIsReadOnce) {
  const ScratchScene scratch(open_loop);
  const Plan plan(scene_file::read_source(scratch.file()), {}, {"friction.coefficient=0.1:0.2:2"});
  std::filesystem::remove(scratch.file());
  EXPECT_NO_THROW(plan.experiment(1));
}

TEST(PlanTest, TheVelocityRatioFollowsTheImpedanceOfThePoint) {
  const ScratchScene scratch(open_loop);
  const Plan plan(scene_file::read_source(scratch.file()), {},
                  {"velocity_ratio=0.5:1:2", "plant.damping_N_s_per_m=0:5000:2"});
  const std::complex<double> i(0.0, 1.0);
  using tests::Table1;
  constexpr double omega = Table1::carrier_rad_per_s;
  constexpr double spring = Table1::stiffness_N_per_m - Table1::inertia_N_per_m;
  for (std::size_t point = 0; point < 4; ++point) {
    const double damping = point % 2 == 0 ? 0.0 : 5000.0;
    const double ratio = point < 2 ? 0.5 : 1.0;
    const double peak = 384.0 * omega / std::abs(spring + i * damping * omega);
    const scene::Sliding sliding = plan.experiment(point).plant.sliding;
    ASSERT_EQ(sliding.profile.size(), 1U);
    EXPECT_NEAR(sliding.profile[0].velocity_m_per_s, ratio * peak, 1e-15);
  }
}

TEST(PlanTest, ErrorsOfAPointNameTheOptionAndThePoint) {
  EXPECT_EQ(error_of(open_loop, {"friction.coefficient=0.1:200:3"}),
            "--vary:1:1: friction.coefficient: 100.05 is out of range; allowed: 0 to 100 "
            "(at friction.coefficient=100.05)");
  EXPECT_EQ(error_of(open_loop, {"friction.coefficient=0.1:0.2:2", "plant.mass=1:2:2"}),
            "--vary:2:1: plant.mass: unknown key; did you mean mass_kg? (at "
            "friction.coefficient=0.1, plant.mass=1)");
  EXPECT_NE(error_of(closed_loop, {"sensor.adc_bits=8:12:4"}).find("--vary:1:1: sensor.adc_bits: "),
            std::string::npos);
}

TEST(PlanTest, ErrorsThatAPointCausesElsewhereNameThePoint) {
  const std::string error = error_of(open_loop + "[solver]\nmethod = \"event_taylor\"\n",
                                     {"run.duration_periods=10:30:2"});
  EXPECT_EQ(error.find("scene.toml:15:24: run.window_start_periods: "), 0U) << error;
  EXPECT_NE(error.find("(at run.duration_periods=10)"), std::string::npos) << error;
}

TEST(PlanTest, TheScenesOwnErrorsAreThoseOfRun) {
  EXPECT_EQ(error_of("[plant]\nmass_kg = -1\n", {"friction.coefficient=0.1:0.2:2"}),
            "scene.toml:2:11: plant.mass_kg: -1 is out of range; allowed: 1e-12 to 1e+06 "
            "kg");
  EXPECT_EQ(error_of(open_loop, {"friction.coefficient=0.1:0.2:2"}, {"plant.weight=1"})
                .find("--set:1:1: plant.weight: unknown key"),
            0U);
}

TEST(PlanTest, AMissingSceneIsAnError) {
  try {
    const Plan plan(scene_file::read_source("nowhere.toml"), {},
                    {"friction.coefficient=0.1:0.2:2"});
    FAIL() << "read a file that is not there";
  } catch (const scene_file::SceneError& error) {
    EXPECT_EQ(std::string(error.what()),
              "nowhere.toml:1:1: scene: No such file or directory; allowed: a readable TOML file");
  }
}

TEST(PlanTest, AKeyHasOneSourceOfItsValue) {
  EXPECT_EQ(
      error_of(open_loop, {"friction.coefficient=0.1:0.2:2", "friction.coefficient=1:2:2"}),
      "--vary:2:1: friction.coefficient: sets what friction.coefficient sets; allowed: one of "
      "them");
  EXPECT_EQ(error_of(open_loop, {"velocity_ratio=0.1:0.2:2", "sliding.velocity_m_per_s=1:2:2"}),
            "--vary:2:1: sliding.velocity_m_per_s: sets what velocity_ratio sets; allowed: one of "
            "them");
  EXPECT_EQ(error_of(open_loop, {"velocity_ratio=0.1:0.2:2"}, {"sliding.velocity_m_per_s=1"}),
            "--set:1:1: sliding.velocity_m_per_s: is varied by --vary velocity_ratio; allowed: one "
            "of the two");
}

TEST(PlanTest, WordsAreVariedAsNumbersAre) {
  const ScratchScene scratch(open_loop);
  const Plan plan(scene_file::read_source(scratch.file()), {},
                  {"solver.method=event_taylor,event_gauss", "friction.coefficient=0.1,0.3,0.2"});
  EXPECT_EQ(plan.describe(4), "solver.method=event_gauss, friction.coefficient=0.3");
  const scene::Scene expected = experiment::read_file(scratch.file(), {"solver.method=event_gauss",
                                                                       "friction.coefficient=0.3"})
                                    .nominal;
  EXPECT_EQ(scene_file::to_json(plan.experiment(4).nominal), scene_file::to_json(expected));
  EXPECT_EQ(plan.wordings(), (std::vector<std::size_t>{0, 3}));
}

// Coulomb's law has no contact stiffness, Dahl's needs one.
TEST(PlanTest, AKeyThatOneWordUsesIsNoErrorWithAnother) {
  const ScratchScene scratch(open_loop);
  const Plan plan(scene_file::read_source(scratch.file()), {}, {"friction.law=coulomb,dahl"});
  EXPECT_EQ(plan.experiment(1).plant.friction.contact_stiffness_N_per_m, 0.056e6);
  EXPECT_EQ(scene_file::to_json(plan.experiment(0).nominal),
            scene_file::to_json(
                experiment::read_file(
                    scratch.file(), {"friction.law=coulomb", "friction.contact_stiffness_N_per_m="})
                    .nominal));
}

TEST(PlanTest, AKeyThatNoWordUsesIsAnError) {
  EXPECT_EQ(error_of(open_loop, {"friction.law=coulomb,none"}),
            "scene.toml:7:29: friction.contact_stiffness_N_per_m: not used at any point of the "
            "sweep; remove it");
  EXPECT_EQ(error_of(open_loop, {"solver.method=event_taylor,strang"}, {"friction.elements=2"}),
            "--set:1:1: friction.elements: not used at any point of the sweep; remove it");
  EXPECT_EQ(error_of(open_loop, {"solver.method=event_taylor,strang", "friction.elements=2,3"},
                     {"solver.tolerance=1e-8"}),
            "--vary:2:1: friction.elements: not used at any point of the sweep; remove it");
}

TEST(PlanTest, WordsThatNoSceneHasNameTheOption) {
  EXPECT_EQ(error_of(open_loop, {"friction.law=dahl,dhal"})
                .find("--vary:1:1: friction.law: \"dhal\" is unknown; did you mean \"dahl\"?"),
            0U);
  EXPECT_EQ(error_of(open_loop, {"velocity_ratio=0.1,fast"}),
            "--vary:1:1: velocity_ratio: \"fast\" is no number; allowed: numbers (at "
            "velocity_ratio=fast)");
}

TEST(PlanTest, AVelocityRatioNeedsAVibration) {
  EXPECT_EQ(
      error_of(closed_loop, {"velocity_ratio=0.1:0.2:2"}).find("--vary:1:1: velocity_ratio: "), 0U);
  EXPECT_EQ(error_of(open_loop, {"velocity_ratio=0.1:0.2:2"}, {"drive.force_amplitude_N=0"})
                .find("--vary:1:1: velocity_ratio: there is no vibration"),
            0U);
}

}  // namespace
}  // namespace sonoglide::sweep::plan_test
