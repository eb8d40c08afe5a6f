#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <vector>

#include "host_sim/runs/batch/run_dahl_plants.hpp"
#include "tests/host_sim/runs/batch/runs/instruction_sets.hpp"
#include "tests/host_sim/runs/batch/runs/plants.hpp"

namespace sonoglide::batch::same_bits_test {
namespace {

constexpr RunLength length = {12, 5};

std::vector<double> numbers(const DahlRun& run) {
  return {run.whole.friction_ratio, run.whole.friction_work,      run.window.friction_ratio,
          run.window.friction_work, run.final_state.displacement, run.final_state.velocity,
          run.final_state.friction};
}

void expect_same_bits(const std::vector<DahlRun>& some, const std::vector<DahlRun>& others) {
  ASSERT_EQ(some.size(), others.size());
  for (std::size_t i = 0; i < some.size(); ++i) {
    const std::vector<double> a = numbers(some[i]);
    const std::vector<double> b = numbers(others[i]);
    EXPECT_EQ(some[i].status, others[i].status) << i;
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)), 0) << i;
  }
}

class SameBits : public testing::TestWithParam<Accuracy> {};

TEST_P(SameBits, APointAloneAndAmongOthers) {
  const std::vector<DahlPlant> plants = random_plants(75, 11);
  on_each_instruction_set([&](const char* name) {
    SCOPED_TRACE(name);
    std::vector<DahlRun> alone;
    for (const DahlPlant& plant : plants) {
      alone.push_back(run_dahl_plants({plant}, length, GetParam())[0]);
    }
    expect_same_bits(run_dahl_plants(plants, length, GetParam()), alone);
  });
}

TEST_P(SameBits, OnEveryInstructionSet) {
  const std::vector<DahlPlant> plants = random_plants(200, 14);
  const std::vector<DahlRun> here = run_dahl_plants(plants, length, GetParam());
  on_each_instruction_set([&](const char* name) {
    SCOPED_TRACE(name);
    expect_same_bits(run_dahl_plants(plants, length, GetParam()), here);
  });
}

TEST_P(SameBits, InAnyOrder) {
  std::vector<DahlPlant> plants = random_plants(75, 12);
  std::vector<DahlRun> runs = run_dahl_plants(plants, length, GetParam());
  std::reverse(plants.begin(), plants.end());
  std::reverse(runs.begin(), runs.end());
  expect_same_bits(run_dahl_plants(plants, length, GetParam()), runs);
}

TEST_P(SameBits, BesidePlantsThatAreGivenUp) {
  std::vector<DahlPlant> plants = random_plants(40, 13);
  const std::vector<DahlRun> undisturbed = run_dahl_plants(plants, length, GetParam());
  DahlPlant resting;
  resting.drive_amplitude = 0.0;
  DahlPlant stuck;
  stuck.contact_stiffness = 1e9;
  stuck.friction_force = 10.0;
  stuck.sliding_velocity = 0.1;
  std::vector<DahlPlant> mixed;
  for (const DahlPlant& plant : plants) {
    mixed.insert(mixed.end(), {resting, plant, stuck});
  }
  const std::vector<DahlRun> runs = run_dahl_plants(mixed, length, GetParam());
  std::vector<DahlRun> kept;
  for (std::size_t i = 1; i < runs.size(); i += 3) {
    EXPECT_NE(runs[i - 1].status, RunStatus::solved);
    EXPECT_NE(runs[i + 1].status, RunStatus::solved);
    kept.push_back(runs[i]);
  }
  expect_same_bits(kept, undisturbed);
}

INSTANTIATE_TEST_SUITE_P(Accuracies, SameBits, testing::Values(Accuracy::map, Accuracy::fine),
                         [](const auto& chosen) {
                           return chosen.param == Accuracy::map ? "map" : "fine";
                         });

}  // namespace
}  // namespace sonoglide::batch::same_bits_test
