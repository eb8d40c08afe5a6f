#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "host_sim/runs/batch/run_dahl_plants.hpp"
#include "tests/common/constants/table_1_numbers.hpp"
#include "tests/host_sim/runs/batch/runs/instruction_sets.hpp"
#include "tests/host_sim/runs/batch/runs/plants.hpp"
#include "tests/host_sim/runs/batch/runs/scalar_run.hpp"

namespace sonoglide::batch::dahl_plants_test {
namespace {

struct Errors {
  double whole = 0.0;
  double window = 0.0;
  double work = 0.0;
};

/// Largest relative errors; every point must be solved.
Errors relative_errors(const std::vector<DahlRun>& runs, const std::vector<DahlRun>& expected) {
  Errors worst;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    EXPECT_EQ(runs[i].status, RunStatus::solved) << i;
    const auto relative = [](double value, double exact) { return std::abs(value / exact - 1.0); };
    worst.whole = std::max(
        worst.whole, relative(runs[i].whole.friction_ratio, expected[i].whole.friction_ratio));
    worst.window = std::max(
        worst.window, relative(runs[i].window.friction_ratio, expected[i].window.friction_ratio));
    worst.work = std::max(worst.work,
                          relative(runs[i].whole.friction_work, expected[i].whole.friction_work));
  }
  return worst;
}

std::vector<DahlRun> scalar_runs(const std::vector<DahlPlant>& plants, const RunLength& length) {
  std::vector<DahlRun> runs;
  for (const DahlPlant& plant : plants) {
    runs.push_back(scalar_run(plant, length));
  }
  return runs;
}

TEST(DahlPlants, SweepOfTable1IsGoodToTheAccuracyAskedFor) {
  const RunLength length = {100, 50};
  const std::vector<DahlPlant> plants = table_1_sweep(16);
  const std::vector<DahlRun> expected = scalar_runs(plants, length);
  const Errors map = relative_errors(run_dahl_plants(plants, length, Accuracy::map), expected);
  EXPECT_LT(map.whole, 1e-4);
  EXPECT_LT(map.window, 2e-4);
  EXPECT_LT(map.work, 5e-4);
  const Errors fine = relative_errors(run_dahl_plants(plants, length, Accuracy::fine), expected);
  EXPECT_LT(fine.whole, 1e-8);
  EXPECT_LT(fine.window, 1e-8);
  EXPECT_LT(fine.work, 2e-8);
}

TEST(DahlPlants, ReferenceOfTable1) {
  // Table 1 at 384 N, velocity ratio 0.5; integrated with twenty digits.
  constexpr tests::DimensionlessTable1 table_1(384.0);
  DahlPlant plant;
  plant.stiffness = table_1.stiffness;
  plant.friction_force = table_1.friction_force;
  plant.contact_stiffness = table_1.contact_stiffness;
  plant.sliding_velocity = 0.5 * table_1.vibration;
  const std::vector<DahlRun> runs = run_dahl_plants({plant}, {100, 50}, Accuracy::fine);
  EXPECT_NEAR(runs[0].whole.friction_ratio, 0.656900288709659, 1e-8);
  EXPECT_NEAR(runs[0].window.friction_ratio, 0.659906711817741, 1e-8);
}

TEST(DahlPlants, RandomPlantsAgreeWithTheScalarSolverOnEveryInstructionSet) {
  const RunLength length = {20, 13};
  const std::vector<DahlPlant> plants = random_plants(203, 1);
  const std::vector<DahlRun> expected = scalar_runs(plants, length);
  on_each_instruction_set([&](const char* name) {
    const std::vector<DahlRun> runs = run_dahl_plants(plants, length, Accuracy::fine);
    for (std::size_t i = 0; i < plants.size(); ++i) {
      ASSERT_EQ(runs[i].status, RunStatus::solved) << name << ' ' << i;
      EXPECT_NEAR(runs[i].whole.friction_ratio, expected[i].whole.friction_ratio, 1e-7)
          << name << ' ' << i;
      EXPECT_NEAR(runs[i].window.friction_ratio, expected[i].window.friction_ratio, 2e-7)
          << name << ' ' << i;
      EXPECT_NEAR(runs[i].final_state.displacement, expected[i].final_state.displacement,
                  1e-6 * (1.0 + std::abs(expected[i].final_state.displacement)))
          << name << ' ' << i;
      EXPECT_LE(std::abs(runs[i].final_state.friction), 1.0) << name << ' ' << i;
    }
  });
}

TEST(DahlPlants, NearlyGrazingReversalsAreNotPassedOver) {
  // The contact velocity of the steady orbit dips below zero, or just not.
  std::vector<DahlPlant> plants;
  for (const double excess : {-1e-2, -1e-4, -1e-6, -1e-9, -1e-12, 1e-12, 1e-9, 1e-6, 1e-4, 1e-2}) {
    DahlPlant plant;
    plant.friction_force = 1e-9;
    plant.contact_stiffness = 5.0;
    plant.sliding_velocity = 1.0 + excess;
    plant.initial.displacement = -1.0;
    plants.push_back(plant);
  }
  const RunLength length = {10, 5};
  const std::vector<DahlRun> expected = scalar_runs(plants, length);
  const std::vector<DahlRun> runs = run_dahl_plants(plants, length, Accuracy::fine);
  for (std::size_t i = 0; i < plants.size(); ++i) {
    ASSERT_EQ(runs[i].status, RunStatus::solved) << i;
    EXPECT_NEAR(runs[i].whole.friction_ratio, expected[i].whole.friction_ratio, 1e-8) << i;
  }
}

TEST(DahlPlants, DipThatOneSampleBarelyMeets) {
  // Free and forced motion beat, so that many a dip of V is about to reach zero or just has.
  std::vector<DahlPlant> plants;
  for (int i = 0; i < 200; ++i) {
    DahlPlant plant;
    plant.stiffness = 0.0468;
    plant.friction_force = 5e-5;
    plant.contact_stiffness = 0.1;
    plant.sliding_velocity = 1.2 + 5e-4 * i;
    plants.push_back(plant);
  }
  const RunLength length = {15, 0};
  const std::vector<DahlRun> expected = scalar_runs(plants, length);
  const std::vector<DahlRun> runs = run_dahl_plants(plants, length, Accuracy::fine);
  for (std::size_t i = 0; i < plants.size(); ++i) {
    EXPECT_NEAR(runs[i].final_state.velocity, expected[i].final_state.velocity, 1e-8) << i;
  }
}

TEST(DahlPlants, FrictionStaysWithinItsLimit) {
  for (const Accuracy accuracy : {Accuracy::map, Accuracy::fine}) {
    for (const DahlRun& run : run_dahl_plants(random_plants(150, 2), {7, 3}, accuracy)) {
      EXPECT_LE(std::abs(run.final_state.friction), 1.0);
      EXPECT_LE(std::abs(run.whole.friction_ratio), 1.0 + 1e-5);
    }
  }
}

TEST(DahlPlants, MapAccuracyOnRandomPlants) {
  const RunLength length = {20, 0};
  std::vector<DahlPlant> plants = random_plants(101, 3);
  const std::vector<DahlRun> expected = scalar_runs(plants, length);
  const std::vector<DahlRun> runs = run_dahl_plants(plants, length, Accuracy::map);
  for (std::size_t i = 0; i < plants.size(); ++i) {
    ASSERT_EQ(runs[i].status, RunStatus::solved) << i;
    EXPECT_NEAR(runs[i].whole.friction_ratio, expected[i].whole.friction_ratio, 2e-3) << i;
  }
}

TEST(DahlPlants, NoPointsNoRuns) {
  EXPECT_TRUE(run_dahl_plants({}, {100, 50}, Accuracy::map).empty());
  EXPECT_TRUE(run_dahl_plants({}, {100, 50}, Accuracy::fine).empty());
}

}  // namespace
}  // namespace sonoglide::batch::dahl_plants_test
