/// What goes wrong outside the controller: sliding that stops, friction that changes, sensors that
/// lie, a drive that is late, targets that keep changing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/acceptance/closed_loop/runs/closed_loop.hpp"
#include "tests/common/csv/csv.hpp"

namespace sonoglide::acceptance::disturbed_loop_test {
namespace {

/// Of periods.csv.
struct DrivenPeriod {
  double time_s;
  double friction_ratio;
  double drive_amplitude_N;
};

std::vector<DrivenPeriod> periods_of(const std::string& scene, Settings settings) {
  const ScratchFolder folder;
  settings.emplace_back("run.record=[\"velocity_m_per_s\"]");
  run_scene(folder, scene, settings);
  const csv::Table table(folder.read("out/periods.csv"));
  std::vector<DrivenPeriod> periods;
  for (const csv::Row& row : table.rows()) {
    periods.push_back(
        {row.number("time_s"), row.number("friction_ratio"), row.number("drive_amplitude_N")});
  }
  return periods;
}

double mean_ratio_from(const std::vector<DrivenPeriod>& periods, double begin_s) {
  double sum = 0.0;
  int count = 0;
  for (const DrivenPeriod& period : periods) {
    if (period.time_s >= begin_s) {
      sum += period.friction_ratio;
      ++count;
    }
  }
  return sum / count;
}

nlohmann::json step_of(const nlohmann::json& summary, std::size_t index = 0) {
  return summary.at("control").at("steps").at(index);
}

std::string first_fault(const nlohmann::json& summary) {
  const nlohmann::json& faults = summary.at("control").at("faults");
  return faults.empty() ? "none" : faults.at(0).at("cause").get<std::string>();
}

/// From 26.72 mm/s to rest within the given time from 4 ms on, and standing still from there on.
Settings stop(double duration_s, const std::string& stiffness_N_per_m) {
  return {"plant.stiffness_N_per_m=" + stiffness_N_per_m,
          "controller.target_friction_ratio=[[0,0.4]]",
          "sliding.profile=[[0,0.02672],[4e-3,0.02672],[" + std::to_string(4e-3 + duration_s) +
              ",0],[1,0]]",
          "run.duration_s=12e-3"};
}

class StopTest : public testing::TestWithParam<std::string> {};

// The notch of 7e6 N/m has a spacing of 4.
TEST_P(StopTest, NeverRaisesTheDrive) {
  for (const double duration_s : {1e-6, 50e-6, 0.2e-3, 1e-3, 4e-3}) {
    const auto periods = periods_of("stop_and_start", stop(duration_s, GetParam()));
    double before_N = 0.0;
    for (const DrivenPeriod& period : periods) {
      if (period.time_s > 3.8e-3 && period.time_s < 4e-3) {
        before_N = std::max(before_N, period.drive_amplitude_N);
      }
    }
    ASSERT_GT(before_N, 100.0);
    int checked = 0;
    for (const DrivenPeriod& period : periods) {
      if (period.time_s > 4e-3) {
        ASSERT_LE(period.drive_amplitude_N, before_N * 1.005)
            << "stop in " << duration_s << " s, at " << period.time_s << " s";
        ++checked;
      }
    }
    EXPECT_NEAR(checked, 8e-3 * 60e3, 2.0);
  }
}

TEST_P(StopTest, TakesTheDriveAwayAfterTheStatedTime) {
  Settings settings = stop(50e-6, GetParam());
  settings.emplace_back("controller.standstill_hold_s=2e-3");
  const auto periods = periods_of("stop_and_start", settings);
  const double gone_s = 4.1e-3 + 2e-3 + 145.0 / 60e3;
  int held = 0;
  int gone = 0;
  for (const DrivenPeriod& period : periods) {
    if (period.time_s > 4.5e-3 && period.time_s < 6e-3) {
      ASSERT_GT(period.drive_amplitude_N, 100.0) << period.time_s;
      ++held;
    }
    if (period.time_s > gone_s) {
      ASSERT_EQ(period.drive_amplitude_N, 0.0) << period.time_s;
      ++gone;
    }
  }
  EXPECT_NEAR(held, 1.5e-3 * 60e3, 2.0);
  EXPECT_NEAR(gone, (12e-3 - gone_s) * 60e3, 2.0);
}

INSTANTIATE_TEST_SUITE_P(Spacings, StopTest, testing::Values("133e6", "7e6"));

Settings friction_jump(double factor) {
  return {"friction.coefficient=",
          "friction.coefficient_profile=[[0,0.1],[50e-3,0.1],[50e-3," +
              std::to_string(0.1 * factor) + "]]",
          "controller.target_friction_ratio=[[0,0.5]]", "run.duration_s=0.1", "run.record=[]"};
}

TEST(FrictionJumpTest, IsNamedWithBelievedOverTrueFriction) {
  for (const double factor : {0.65, 1.5, 1.9}) {
    const nlohmann::json step = step_of(summary_of("target_step", friction_jump(factor)));
    EXPECT_EQ(step.at("limit"), "mismatch") << factor;
    EXPECT_EQ(step.at("limit_seen_by"), "controller") << factor;
    // The map takes the presliding travel from the believed friction force.
    EXPECT_NEAR(step.at("mismatch").get<double>() * factor, 1.0, 0.2) << factor;
    EXPECT_NEAR(step.at("steady_error").get<double>(), 0.5 / factor - 0.5, 0.005) << factor;
  }
}

TEST(FrictionJumpTest, IsLearntInTheNextPause) {
  for (const double factor : {0.5, 1.5}) {
    Settings settings = friction_jump(factor);
    settings.emplace_back("controller.relearn_every_s=20e-3");
    const nlohmann::json summary = summary_of("target_step", settings);
    expect_no_fault(summary);
    EXPECT_EQ(step_of(summary).at("limit"), "none");
    EXPECT_NEAR(step_of(summary).at("steady_error").get<double>(), 0.0, 0.002);
    settings.pop_back();
    settings.back() = "controller.relearn_every_s=20e-3";
    int checked = 0;
    for (const DrivenPeriod& period : periods_of("target_step", settings)) {
      if (period.time_s > 60e-3 + 14.0 / 60e3 && period.time_s < 80e-3) {
        ASSERT_NEAR(period.friction_ratio, 0.5, 0.02) << factor << " at " << period.time_s;
        ++checked;
      }
    }
    EXPECT_NEAR(checked, 20e-3 * 60e3 - 14.0, 2.0);
  }
}

// 3 to 5 ms of the example scene: 120 carrier periods, less those in which the loop settles.
TEST(FrictionJumpTest, IsCountedThoughItIsMendedInTheEnd) {
  const nlohmann::json summary = summary_of("friction_jump");
  const nlohmann::json& control = summary.at("control");
  EXPECT_EQ(step_of(summary).at("limit"), "none");
  EXPECT_NEAR(step_of(summary).at("steady_error").get<double>(), 0.0, 0.01);
  EXPECT_EQ(control.at("relearning").at("pauses"), 2);
  EXPECT_GT(control.at("limited_periods").at("mismatch"), 60);
  EXPECT_LT(control.at("limited_periods").at("mismatch"), 120);
  EXPECT_EQ(control.at("limited_periods").at("not_settling"), 0);
}

TEST(RelearningTest, DisturbsTheDriveForTenPeriods) {
  const auto periods =
      periods_of("target_step", {"controller.target_friction_ratio=[[0,0.5]]",
                                 "controller.relearn_every_s=20e-3", "run.duration_s=65e-3"});
  int disturbed = 0;
  for (const DrivenPeriod& period : periods) {
    const bool settled = period.time_s > 2e-3;
    disturbed += settled && std::abs(period.drive_amplitude_N - 526.3) > 5.0 ? 1 : 0;
  }
  EXPECT_EQ(disturbed, 3 * 10);
}

// Coulomb's map is not that of a vibration across the sliding: feedback makes up for it, and a
// pause that finds the friction force as it was leaves that as it is.
TEST(RelearningTest, LeavesWhatFeedbackHasFound) {
  Settings settings{"friction.law=transverse_coulomb", "friction.contact_stiffness_N_per_m=",
                    "controller.target_friction_ratio=[[0,0.7]]", "run.duration_s=20e-3"};
  EXPECT_LT(step_of(summary_of("target_step", settings)).at("settling_time_s"), 1e-3);
  settings.emplace_back("controller.relearn_every_s=1.5e-3");
  const nlohmann::json summary = summary_of("target_step", settings);
  EXPECT_LT(step_of(summary).at("settling_time_s"), 2e-3);
  // Every 1.5 ms in 20 ms, and a pause takes some periods itself.
  EXPECT_GE(summary.at("control").at("relearning").at("pauses"), 12);
  EXPECT_LE(summary.at("control").at("relearning").at("pauses"), 13);
}

TEST(RelearningTest, TellsWhatThePausesCost) {
  const nlohmann::json summary =
      summary_of("target_step", {"controller.target_friction_ratio=[[0,0.5]]", "run.record=[]",
                                 "controller.relearn_every_s=0.1", "run.duration_s=1"});
  const nlohmann::json& cost = summary.at("control").at("relearning");
  EXPECT_EQ(cost.at("pauses"), 9);
  EXPECT_GE(cost.at("time_fraction").get<double>(), 9.0 * 10.0 / 60e3) << "ten periods each";
  EXPECT_LE(cost.at("time_fraction").get<double>(), 0.0025);
  EXPECT_GT(cost.at("ratio_cost").get<double>(), 0.0);
  EXPECT_LE(cost.at("ratio_cost").get<double>(), 0.001);
  EXPECT_LE(step_of(summary).at("settling_time_s").get<double>(), 10.001 / 60e3);
}

TEST(LyingSensorTest, WiredBackwardsIsAFaultWithAndWithoutACalibration) {
  for (const char* calibration : {"0", "0.5e-3"}) {
    const std::string calibrated = std::string("controller.calibration_s=") + calibration;
    for (const char* gain : {"sensor.force_gain=-1", "sensor.velocity_gain=-1"}) {
      EXPECT_EQ(first_fault(summary_of("target_step", {gain, calibrated})),
                "measurement_implausible")
          << gain << ' ' << calibration;
    }
  }
}

TEST(LyingSensorTest, AnOffsetIsLearntByAReversalInTheCalibration) {
  const nlohmann::json summary = summary_of(
      "target_step",
      {"sensor.force_offset_N=4e-3", "controller.calibration_s=2e-3",
       "sliding.velocity_m_per_s=", "controller.target_friction_ratio=[[0,0.5]]",
       "sliding.profile=[[0,-0.02672],[0.9e-3,-0.02672],[1.1e-3,0.02672]]", "run.duration_s=8e-3"});
  expect_no_fault(summary);
  EXPECT_NEAR(step_of(summary).at("steady_error").get<double>(), 0.0, 0.002);
  EXPECT_EQ(step_of(summary).at("limit"), "none");
}

TEST(LyingSensorTest, AnOffsetIsTaredAtStandstillInTheCalibration) {
  const nlohmann::json summary = summary_of(
      "target_step", {"sensor.force_offset_N=4e-3", "controller.calibration_s=3e-3",
                      "sliding.velocity_m_per_s=", "controller.target_friction_ratio=[[0,0.5]]",
                      "sliding.profile=[[0,0],[1e-3,0],[1.2e-3,0.02672]]", "run.duration_s=9e-3"});
  expect_no_fault(summary);
  EXPECT_NEAR(step_of(summary).at("steady_error").get<double>(), 0.0, 0.002);
}

TEST(LyingSensorTest, AStepOffItsTargetIsNeverSilent) {
  for (const char* lie :
       {"sensor.force_offset_N=2e-3", "sensor.force_offset_N=-2e-3", "sensor.force_gain=1.1",
        "sensor.velocity_gain=1.5", "sensor.velocity_offset_m_per_s=5e-3"}) {
    const nlohmann::json summary = summary_of("target_step", {lie});
    for (const nlohmann::json& step : summary.at("control").at("steps")) {
      EXPECT_TRUE(!step.at("settling_time_s").is_null() || step.at("limit") != "none" ||
                  first_fault(summary) != "none")
          << lie;
    }
  }
}

TEST(DriveLatencyTest, IsCountedByTheDesign) {
  for (const int periods : {0, 1, 2, 4, 8}) {
    const nlohmann::json summary =
        summary_of("target_step", {"drive.delay_periods=" + std::to_string(periods)});
    expect_steps_within(summary, {(6.0 + periods) * 1.001 / 60e3, 0.001, 0.002});
  }
}

TEST(TargetStreamTest, LeavesFeedbackOn) {
  std::string tiny = "[0,0.5]";
  std::string large = "[0,0.45]";
  for (int i = 1; i < 200; ++i) {
    const std::string time_s = std::to_string(i * 5.0 / 60e3);
    tiny += ",[" + time_s + (i % 2 == 0 ? ",0.5]" : ",0.500001]");
    large += ",[" + time_s + (i % 2 == 0 ? ",0.45]" : ",0.55]");
  }
  const Settings base = {"model_error.contact_stiffness=0.3", "run.duration_s=15e-3"};
  for (const std::string& targets : {tiny, large}) {
    Settings settings = base;
    settings.push_back("controller.target_friction_ratio=[" + targets + "]");
    EXPECT_NEAR(mean_ratio_from(periods_of("target_step", settings), 8e-3), 0.5, 0.01);
  }
}

}  // namespace
}  // namespace sonoglide::acceptance::disturbed_loop_test
