#include "host_sim/studies/robust/task.hpp"
#include "host_sim/configure/read/experiment.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "host_sim/loop/run.hpp"
#include "host_sim/scene_file/scene_error.hpp"
#include "host_sim/studies/robust/study.hpp"
#include "robust_scenes.hpp"

namespace sonoglide::robust::task_test {
namespace {

Task task_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return Task({"s.toml", text}, overrides, {64, 0, 1});
}

std::string error_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    task_of(text, overrides);
  } catch (const scene_file::SceneError& error) {
    return error.what();
  }
  return "none";
}

TEST(TaskTest, WantsAControllerAndATolerance) {
  EXPECT_EQ(error_of(target_step),
            "s.toml:1:1: tolerance: no key may vary; required: a table [tolerance] with at least "
            "one of them, such as \"plant.stiffness_N_per_m\" = 0.04");
  EXPECT_EQ(
      error_of(table_1_open_loop + "[run]\nduration_periods = 9\n"),
      "s.toml:1:1: controller: missing; required: a table [controller], whose loop is to hold "
      "inside the tolerances");
}

TEST(TaskTest, PlantsAreInsideTheTolerancesAndTheControllerBelievesTheScene) {
  const Task task = task_of(uncertain_step);
  for (std::size_t i = 0; i < task.counts().samples; ++i) {
    const scene::Scene plant = task.plant(task.sample(i));
    EXPECT_NEAR(plant.plant.stiffness_N_per_m, 133e6, 0.04 * 133e6);
    EXPECT_GE(plant.friction.contact_stiffness_N_per_m, 0.05e6);
    EXPECT_LE(plant.friction.contact_stiffness_N_per_m, 0.06e6);
    EXPECT_EQ(plant.friction.normal_force_N, task.nominal().friction.normal_force_N);
    EXPECT_EQ(task.nominal().plant.stiffness_N_per_m, 133e6);
  }
}

TEST(TaskTest, NotesWhatTheDesignAndTheTolerancesGiveToThinkAbout) {
  EXPECT_TRUE(task_of(uncertain_step).notes().empty());
  const std::vector<std::string> notes =
      task_of(uncertain_step,
              {"controller.shaping=robust",
               "tolerance.friction.contact_stiffness_N_per_m={ range = [0.06e6, 0.07e6] }"})
          .notes();
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_EQ(notes[0].find("The natural mode hardly decays."), 0U) << notes[0];
  EXPECT_EQ(notes[1],
            "The range of friction.contact_stiffness_N_per_m, 60000 to 70000, does not contain the "
            "scene's value of 56000, for which the controller is designed.");
}

/// The file of a plant is the same plant, to the last command of its controller.
TEST(TaskTest, TheTextOfAPlantIsThatPlant) {
  for (const std::string more :
       {"", "\"drive.max_force_amplitude_N\" = 0.1\n\"drive.frequency_Hz\" = 1e-4\n",
        "[true_values]\n\"plant.mass_kg\" = 0.021\n"}) {
    const std::string text = uncertain_step + more;
    const Task task =
        task_of(text, {"run.record=[\"displacement_m\"]", "run.record_interval_s=1e-6"});
    const Factors factors = task.sample(5);
    const PlantRow row = run_plants({task.plant(factors)}, task.design()).front();
    const auto again = experiment::read_text(task.plant_text(factors), "worst.toml");
    EXPECT_TRUE(again.nominal.tolerances.empty());
    EXPECT_EQ(again.plant.run.record.size(), 1U);
    EXPECT_EQ(loop::run(again).control->trace_hash, row.trace_hash) << text;
  }
}

/// A belief that is wrong by a factor is the same loop however the scene puts it. The factors leave
/// every product exact.
TEST(TaskTest, ATrueValueIsTheOtherSideOfAModelError) {
  struct Case {
    const char* true_value;  ///< TABLE.KEY=VALUE
    const char* stated;      ///< the scene's, by which the controller goes
    const char* error;       ///< model_error.KEY=VALUE
  };
  const std::vector<std::string> fixed = {"friction.normal_force_N=0.1962",
                                          "sensor.force_full_scale_N=0.0625",
                                          "sensor.force_bandwidth_Hz=5e3"};
  for (const Case& each :
       {Case{"plant.stiffness_N_per_m=133e6", "plant.stiffness_N_per_m=166.25e6", "stiffness=1.25"},
        Case{"plant.mass_kg=0.03125", "plant.mass_kg=0.0234375", "mass=0.75"},
        Case{"friction.coefficient=0.125", "friction.coefficient=0.15625", "coefficient=1.25"},
        Case{"friction.contact_stiffness_N_per_m=56e3", "friction.contact_stiffness_N_per_m=84e3",
             "contact_stiffness=1.5"}}) {
    std::vector<std::string> by_error = fixed;
    by_error.insert(by_error.end(), {each.true_value, std::string("model_error.") + each.error});
    std::vector<std::string> by_truth = fixed;
    by_truth.insert(by_truth.end(), {each.stated, std::string("true_values.") + each.true_value});
    const auto hash = [](const std::vector<std::string>& overrides) {
      return loop::run(experiment::read_text(target_step, "s", overrides)).control->trace_hash;
    };
    EXPECT_EQ(hash(by_truth), hash(by_error)) << each.true_value;
    EXPECT_NE(hash(by_truth), hash(fixed)) << each.true_value;
  }
}

TEST(TaskTest, AnImpossiblePlantIsToldAtItsTolerance) {
  const std::string text = target_step + R"([tolerance]
"friction.initial_force_N" = { range = [-5.0, 5.0] }
)";
  const Task task = task_of(text);
  try {
    task.plant({4.0});
    FAIL();
  } catch (const scene_file::SceneError& error) {
    EXPECT_EQ(
        std::string(error.what())
            .find(
                "s.toml:21:30: tolerance.friction.initial_force_N: friction.initial_force_N: 4 is "
                "out of range; allowed: "),
        0U)
        << error.what();
  }
}

}  // namespace
}  // namespace sonoglide::robust::task_test
