/// A natural mode far below the carrier, which the friction moves: a bias quiets it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/acceptance/closed_loop/runs/closed_loop.hpp"
#include "tests/common/csv/csv.hpp"

namespace sonoglide::acceptance::slow_mode_test {
namespace {

/// Table 1's mass on a spring of 0.03 carrier frequencies, pressed on more firmly.
Settings slow(Settings more) {
  for (const char* setting :
       {"plant.stiffness_N_per_m=2.558e6", "friction.normal_force_N=40",
        "friction.contact_stiffness_N_per_m=11.4e6", "drive.max_force_amplitude_N=2200"}) {
    more.emplace_back(setting);
  }
  return more;
}

constexpr const char* bias = "drive.bias_limit_N=10";

constexpr Bounds prompt{1e-3, 0.003, 0.005};

TEST(SlowMode, RingsWithoutABias) {
  for (const char* scene : {"damped_step", "damped_by_force"}) {
    const nlohmann::json summary = summary_of(scene, slow({}));
    EXPECT_FALSE(steps_of(summary).front().settling_time_s) << scene;
    EXPECT_FALSE(summary.at("control").contains("bias"));
  }
}

TEST(SlowMode, SettlesWithinAMillisecondWithABias) {
  for (const char* scene : {"damped_step", "damped_by_force"}) {
    for (const std::string& arithmetic : arithmetics) {
      for (const char* stiffness : {"0.95", "1", "1.05"}) {
        SCOPED_TRACE(std::string(scene) + " " + arithmetic + " " + stiffness);
        const nlohmann::json summary =
            summary_of(scene, slow({bias, "controller.arithmetic=" + arithmetic,
                                    std::string("model_error.stiffness=") + stiffness}));
        expect_steps_within(summary, prompt);
        EXPECT_NEAR(summary.at("control").at("bias").at("part").get<double>(), 0.33, 0.01);
        EXPECT_LT(summary.at("power").at("balance_residual").get<double>(), 1e-9);
      }
    }
  }
}

/// The longer the delay of the drive, the less a bias may take away.
TEST(SlowMode, SettlesWithTheDelayOfTheLoop) {
  for (const char* scene : {"damped_step", "damped_by_force"}) {
    for (const char* delay : {"0", "2", "3"}) {
      SCOPED_TRACE(std::string(scene) + " " + delay);
      const nlohmann::json summary =
          summary_of(scene, slow({bias, std::string("drive.delay_periods=") + delay}));
      expect_no_fault(summary);
      for (const Step& step : steps_of(summary)) {
        EXPECT_TRUE(step.settling_time_s) << step.target;
      }
    }
  }
}

TEST(SlowMode, ASmallBiasIsNamedAsALimitAndStaysInsideIt) {
  const ScratchFolder folder;
  const nlohmann::json summary =
      run_scene(folder, "damped_step",
                slow({"drive.bias_limit_N=0.05", "run.record=[\"velocity_m_per_s\"]",
                      "run.record_interval_s=1e-5"}));
  expect_no_fault(summary);
  EXPECT_GT(summary.at("control").at("limited_periods").at("bias"), 20);
  EXPECT_LE(summary.at("control").at("bias").at("largest_N").get<double>(), 0.05);
  const csv::Table table(folder.read("out/periods.csv"));
  double largest_N = 0.0;
  int named = 0;
  for (const csv::Row& row : table.rows()) {
    largest_N = std::max(largest_N, std::abs(row.number("bias_N")));
    named += row.text("limit") == "bias" ? 1 : 0;
  }
  EXPECT_NEAR(largest_N, 0.05, 1e-9);
  EXPECT_GT(named, 20);
}

TEST(SlowMode, AFaultTakesTheBiasToZero) {
  const ScratchFolder folder;
  // Wired backwards.
  const nlohmann::json summary =
      run_scene(folder, "damped_step",
                slow({bias, "sensor.force_gain=-1", "run.record=[\"velocity_m_per_s\"]",
                      "run.record_interval_s=1e-5"}));
  ASSERT_FALSE(summary.at("control").at("faults").empty());
  const double fault_s = summary.at("control").at("faults").at(0).at("time_s");
  const csv::Table table(folder.read("out/periods.csv"));
  int after = 0;
  for (const csv::Row& row : table.rows()) {
    if (row.number("time_s") > fault_s + 2.0 / 60e3) {
      EXPECT_EQ(row.number("bias_N"), 0.0);
      ++after;
    }
  }
  EXPECT_GT(after, 100);
}

TEST(SlowMode, OtherScenesHaveNoColumnOfIt) {
  const ScratchFolder folder;
  run_scene(folder, "damped_step",
            {"run.record=[\"velocity_m_per_s\"]", "run.record_interval_s=1e-5"});
  EXPECT_EQ(folder.read("out/periods.csv").find("bias_N"), std::string::npos);
}

}  // namespace
}  // namespace sonoglide::acceptance::slow_mode_test
