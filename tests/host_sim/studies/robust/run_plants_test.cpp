#include "host_sim/studies/robust/study.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "host_sim/runs/closed_loops.hpp"
#include "host_sim/studies/robust/task.hpp"
#include "robust_scenes.hpp"

namespace sonoglide::robust::run_plants_test {
namespace {

/// The same samples for every tolerance of the solver.
std::vector<scene::Scene> plants_of(const Task& task) {
  std::vector<scene::Scene> plants;
  for (std::size_t i = 0; i < task.counts().samples; ++i) {
    plants.push_back(task.plant(task.sample(i)));
  }
  return plants;
}

Task task_with(const std::string& tolerance) {
  return Task({"s.toml", uncertain_step}, {"solver.tolerance=" + tolerance}, {24, 0, 3});
}

TEST(RunPlants, InLanesTheRowsAreThoseOfFineRuns) {
  const Task coarse = task_with("1e-6");
  const Task fine = task_with("1e-10");
  const std::vector<scene::Scene> plants = plants_of(coarse);
  for (const scene::Scene& plant : plants) {
    ASSERT_TRUE(runs::runs_in_lanes(plant));
  }
  const std::vector<PlantRow> rows = run_plants(plants, coarse.design());
  const std::vector<PlantRow> expected = run_plants(plants_of(fine), fine.design());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].status, "ok");
    EXPECT_EQ(rows[i].unsettled, expected[i].unsettled) << i;
    EXPECT_EQ(rows[i].limits, expected[i].limits) << i;
    EXPECT_NEAR(rows[i].steady_error, expected[i].steady_error, 1e-6) << i;
    EXPECT_NEAR(rows[i].ripple, expected[i].ripple, 2e-6) << i;
  }
}

TEST(RunPlants, ARowIsTheSameAloneAndAmongOthers) {
  const Task task = task_with("1e-6");
  const std::vector<scene::Scene> plants = plants_of(task);
  const std::vector<PlantRow> rows = run_plants(plants, task.design());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const PlantRow alone = run_plants({plants[i]}, task.design()).front();
    EXPECT_EQ(record_text(Record{i, alone}), record_text(Record{i, rows[i]}));
  }
}

TEST(RunPlants, WhatTheLanesGiveUpIsRunAlone) {
  const Task task = task_with("1e-6");
  scene::Scene stuck = task.nominal();
  stuck.friction.coefficient = 1e6;
  stuck.friction.contact_stiffness_N_per_m = 1e16;
  stuck.run.duration_s = 1e-4;
  ASSERT_TRUE(runs::runs_in_lanes(stuck));
  const std::vector<PlantRow> rows = run_plants({stuck, task.nominal()}, task.design());
  EXPECT_NE(rows[0].trace_hash, 0U);  // it has a row of its own, whatever it says
  EXPECT_EQ(record_text(Record{1, rows[1]}),
            record_text(Record{1, run_plants({task.nominal()}, task.design()).front()}));
}

}  // namespace
}  // namespace sonoglide::robust::run_plants_test
