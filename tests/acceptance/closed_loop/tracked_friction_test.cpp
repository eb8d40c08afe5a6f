/// Friction that is learnt while driving: lies of the scene, jumps and drifts of the friction.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/acceptance/closed_loop/runs/closed_loop.hpp"
#include "tests/common/csv/csv.hpp"

namespace sonoglide::acceptance::tracked_friction_test {
namespace {

Settings tracked(Settings more) {
  more.emplace_back("controller.friction=tracked");
  more.emplace_back("sensor.force_full_scale_N=0.08");
  return more;
}

bool holds(const nlohmann::json& figure, double truth) {
  return figure.at("low_95") <= truth && truth <= figure.at("high_95");
}

/// Part of the carrier periods from a time on whose ratio is within a band of 0.5.
double part_within(Settings settings, double from_s, double band = 0.02) {
  const ScratchFolder folder;
  settings.emplace_back("controller.target_friction_ratio=[[0,0.4],[2e-3,0.6],[4e-3,0.5]]");
  settings.emplace_back("run.record=[\"friction_force_N\"]");
  settings.emplace_back("run.record_interval_s=1e-4");
  expect_no_fault(run_scene(folder, "target_step", settings));
  const csv::Table table(folder.read("out/periods.csv"));
  int within = 0;
  int seen = 0;
  for (const csv::Row& row : table.rows()) {
    if (from_s <= row.number("time_s")) {
      within += std::abs(row.number("friction_ratio") - 0.5) < band ? 1 : 0;
      ++seen;
    }
  }
  return static_cast<double>(within) / seen;
}

TEST(TrackedFriction, FindsWhatTheSceneHasWrong) {
  for (const std::string& arithmetic : arithmetics) {
    for (const char* coefficient : {"1.3", "0.7"}) {
      for (const char* stiffness : {"1.5", "0.5"}) {
        const nlohmann::json summary = summary_of(
            "target_step", tracked({"controller.arithmetic=" + arithmetic, "run.record=[]",
                                    "run.settling_band=0.02",
                                    std::string("model_error.coefficient=") + coefficient,
                                    std::string("model_error.contact_stiffness=") + stiffness}));
        const std::string loop = arithmetic + " " + coefficient + " " + stiffness;
        expect_no_fault(summary);
        for (const Step& step : steps_of(summary)) {
          EXPECT_LE(step.settling_time_s.value_or(1.0), 1.2e-3) << loop;
          EXPECT_NEAR(step.steady_error, 0.0, 0.005) << loop;
          EXPECT_EQ(step.limit, "none") << loop;
        }
        const nlohmann::json& friction = summary.at("control").at("friction");
        EXPECT_TRUE(holds(friction.at("Fc_N"), 0.01962)) << loop << friction;
        EXPECT_TRUE(holds(friction.at("contact_stiffness_N_per_m"), 0.056e6)) << loop << friction;
        EXPECT_TRUE(holds(friction.at("gain"), 1.0)) << loop << friction;
        EXPECT_LT(friction.at("Fc_N").at("high_95"), 0.01962 * 1.03) << loop;
      }
    }
  }
}

TEST(TrackedFriction, FindsAForceFactorThatIsAQuarterOff) {
  for (const double factor : {0.75, 1.25}) {
    const nlohmann::json summary = summary_of(
        "target_step",
        tracked({"run.record=[]",
                 "drive.max_force_amplitude_N=", "drive.max_voltage_amplitude_V=120",
                 "transducer.force_factor_N_per_V=16", "transducer.clamped_capacitance_F=2e-6",
                 "true_values.\"transducer.force_factor_N_per_V\"=" + std::to_string(16.0 * factor),
                 "model_error.coefficient=1.2", "model_error.contact_stiffness=0.7"}));
    expect_no_fault(summary);
    for (const nlohmann::json& step : summary.at("control").at("steps")) {
      EXPECT_NEAR(step.at("steady_error").get<double>(), 0.0, 0.005) << factor;
    }
    const nlohmann::json& friction = summary.at("control").at("friction");
    EXPECT_TRUE(holds(friction.at("gain"), factor)) << friction;
    EXPECT_TRUE(holds(friction.at("Fc_N"), 0.01962)) << friction;
  }
}

/// Mass and stiffness that are off by one factor act as a drive that is off by it: the natural mode stays.
TEST(TrackedFriction, HoldsEveryConstantBesideAGainThatIsFifteenPercentOff) {
  for (const std::string& arithmetic : arithmetics) {
    for (const char* gain : {"0.85", "1.15"}) {
      for (const char* stiffness : {"1.5", "1", "0.5"}) {
        const nlohmann::json summary =
            summary_of("target_step",
                       tracked({"controller.arithmetic=" + arithmetic, "run.record=[]",
                                "run.settling_band=0.02", std::string("model_error.mass=") + gain,
                                std::string("model_error.stiffness=") + gain,
                                std::string("model_error.contact_stiffness=") + stiffness}));
        expect_no_fault(summary);
        const std::string loop = arithmetic + " " + gain + " " + stiffness + " ";
        for (const Step& step : steps_of(summary)) {
          EXPECT_TRUE(step.settling_time_s) << loop;
        }
        EXPECT_NEAR(steps_of(summary).back().steady_error, 0.0, 0.001) << loop;
        const nlohmann::json& friction = summary.at("control").at("friction");
        EXPECT_TRUE(holds(friction.at("Fc_N"), 0.01962)) << loop << friction;
        EXPECT_LT(friction.at("Fc_N").at("high_95"), 0.01962 * 1.06) << loop;
        EXPECT_TRUE(holds(friction.at("contact_stiffness_N_per_m"), 0.056e6)) << loop << friction;
        EXPECT_TRUE(holds(friction.at("gain"), std::stod(gain))) << loop << friction;
      }
    }
  }
}

TEST(TrackedFriction, HoldsTheTrueRatioFiveMillisecondsAfterAJump) {
  for (const std::string& arithmetic : arithmetics) {
    for (const char* jumped : {"0.15", "0.05"}) {
      for (const char* stiffness : {"1.0", "1.5", "0.5"}) {
        const double part = part_within(
            tracked({"friction.coefficient=",
                     std::string("friction.coefficient_profile=[[0,0.1],[6e-3,0.1],[6e-3,") +
                         jumped + "]]",
                     std::string("model_error.contact_stiffness=") + stiffness,
                     "controller.arithmetic=" + arithmetic, "run.duration_s=14e-3"}),
            11e-3);
        EXPECT_EQ(part, 1.0) << arithmetic << " " << jumped << " " << stiffness;
      }
    }
  }
}

TEST(TrackedFriction, FollowsAFrictionThatDrifts) {
  for (const std::string& arithmetic : arithmetics) {
    for (const double end : {0.15, 0.05}) {
      const Settings drift = tracked(
          {"friction.coefficient=",
           "friction.coefficient_profile=[[0,0.1],[6e-3,0.1],[26e-3," + std::to_string(end) + "]]",
           "solver.tolerance=1e-6",  // by default a slope takes four times as long
           "controller.arithmetic=" + arithmetic, "run.duration_s=26e-3"});
      EXPECT_GT(part_within(drift, 6e-3, 0.01), 0.99) << arithmetic << " " << end;
      Settings measured = drift;
      measured.emplace_back("run.record=[]");
      const nlohmann::json friction =
          summary_of("target_step", measured).at("control").at("friction");
      EXPECT_TRUE(holds(friction.at("Fc_N"), 0.1962 * end)) << friction;
      EXPECT_LT(friction.at("Fc_N").at("high_95"), 0.1962 * end * 1.06) << friction;
    }
  }
}

/// The drift is in every reading by which the constants are told apart.
TEST(TrackedFriction, FollowsAFrictionThatDriftsFromTheStart) {
  for (const std::string& arithmetic : arithmetics) {
    for (const double end : {0.15, 0.13, 0.09, 0.07, 0.05}) {
      for (const double duration_s : {6e-3, 8e-3, 12e-3}) {
        const nlohmann::json friction =
            summary_of("target_step", tracked({"friction.coefficient=",
                                               "friction.coefficient_profile=[[0,0.1],[26e-3," +
                                                   std::to_string(end) + "]]",
                                               "controller.arithmetic=" + arithmetic,
                                               "run.record=[]", "solver.tolerance=1e-6",
                                               "run.duration_s=" + std::to_string(duration_s)}))
                .at("control")
                .at("friction");
        const double truth = 0.1962 * (0.1 + (end - 0.1) * duration_s / 26e-3);
        const std::string loop = arithmetic + " " + std::to_string(end);
        EXPECT_TRUE(holds(friction.at("Fc_N"), truth)) << loop << " " << truth << friction;
        if (8e-3 <= duration_s) {  // before that all may be in the middle of being learnt again
          EXPECT_LT(friction.at("Fc_N").at("high_95"), truth * 1.06) << loop;
        }
      }
    }
  }
}

/// The first reading at a target doubles Kt, at a ratio that has settled already.
TEST(TrackedFriction, DoesNotSwingByALargeCorrection) {
  const ScratchFolder folder;
  expect_no_fault(
      run_scene(folder, "target_step",
                tracked({"model_error.contact_stiffness=0.5", "run.duration_s=2e-3",
                         "run.record=[\"friction_force_N\"]", "run.record_interval_s=1e-4"})));
  const csv::Table table(folder.read("out/periods.csv"));
  for (const csv::Row& row : table.rows()) {
    if (1.4e-3 <= row.number("time_s")) {
      EXPECT_NEAR(row.number("friction_ratio"), 0.4, 0.004) << row.number("time_s");
    }
  }
}

/// Whenever the run ends after a jump: before a reading, in a dip or with the loop settled again.
TEST(TrackedFriction, IsNotSureWhileTheLoopContradictsIt) {
  for (const char* jumped : {"0.15", "0.05"}) {
    for (const char* end : {"6.2e-3", "6.4e-3", "6.7e-3", "7e-3", "7.5e-3", "9e-3"}) {
      const nlohmann::json summary = summary_of(
          "target_step",
          tracked({"friction.coefficient=",
                   std::string("friction.coefficient_profile=[[0,0.1],[6e-3,0.1],[6e-3,") + jumped +
                       "]]",
                   "run.record=[]", std::string("run.duration_s=") + end}));
      const nlohmann::json& force = summary.at("control").at("friction").at("Fc_N");
      EXPECT_TRUE(holds(force, 0.1962 * std::stod(jumped))) << jumped << " " << end << force;
    }
  }
}

/// Far outside of the 30 % that are taken for the deviation of Fc.
TEST(TrackedFriction, IsNeverSureOfAForceThatIsWrong) {
  for (const std::string& arithmetic : arithmetics) {
    for (const char* nominal : {"0.2", "0.333", "0.5", "2", "3"}) {
      const nlohmann::json summary =
          summary_of("target_step", tracked({"controller.arithmetic=" + arithmetic, "run.record=[]",
                                             std::string("model_error.coefficient=") + nominal}));
      const nlohmann::json& friction = summary.at("control").at("friction");
      EXPECT_TRUE(holds(friction.at("Fc_N"), 0.01962)) << arithmetic << nominal << friction;
      EXPECT_TRUE(holds(friction.at("contact_stiffness_N_per_m"), 0.056e6))
          << arithmetic << nominal << friction;
      EXPECT_TRUE(holds(friction.at("gain"), 1.0)) << arithmetic << nominal << friction;
    }
  }
}

/// Without a notch, and with a damping that takes 1 to 3 ms: the mass rings through each dip, and later no more.
TEST(TrackedFriction, HoldsAForceThatWasReadWhileTheMassRang) {
  for (const std::string& arithmetic : arithmetics) {
    for (const char* stiffness : {"60e6", "133e6", "250e6", "600e6"}) {
      for (const double coefficient : {0.1, 0.13}) {
        const nlohmann::json control =
            summary_of(
                "target_step",
                tracked({"controller.arithmetic=" + arithmetic, "run.record=[]",
                         "controller.shaping=none", "run.settling_band=0.02",
                         "run.duration_s=24e-3",
                         "controller.target_friction_ratio=[[0,0.4],[8e-3,0.6],[16e-3,0.5]]",
                         std::string("plant.stiffness_N_per_m=") + stiffness,
                         "plant.damping_N_s_per_m=20",
                         "true_values.\"friction.coefficient\"=" + std::to_string(coefficient)}))
                .at("control");
        const nlohmann::json& force = control.at("friction").at("Fc_N");
        EXPECT_TRUE(holds(force, 0.1962 * coefficient)) << arithmetic << stiffness << force;
        EXPECT_LT(force.at("high_95"), 0.1962 * coefficient * 1.25) << arithmetic << stiffness;
        EXPECT_NE(control.at("notes").dump().find("reaches down to their mean"), std::string::npos);
      }
    }
  }
}

/// At 191.98 kHz and 180 kHz: the second at three times the carrier, where a reading looks the same throughout.
TEST(TrackedFriction, IsSaidNotToShowAMassThatRingsAtAMultipleOfTheCarrier) {
  for (const char* stiffness : {"2.9101e10", "2.5582e10"}) {
    const std::string notes =
        summary_of("target_step", tracked({"run.record=[]", "controller.shaping=none",
                                           "drive.max_force_amplitude_N=6000",
                                           std::string("plant.stiffness_N_per_m=") + stiffness}))
            .at("control")
            .at("notes")
            .dump();
    EXPECT_EQ(notes.find("no interval includes") != std::string::npos,
              std::string(stiffness) == "2.5582e10")
        << stiffness << notes;
  }
}

TEST(TrackedFriction, DipsOnceForATargetBeyondTheDrive) {
  const nlohmann::json control =
      summary_of("target_step",
                 tracked({"controller.target_friction_ratio=[[0,0.05]]", "run.duration_s=30e-3"}))
          .at("control");
  EXPECT_EQ(control.at("steps")[0].at("limit"), "actuator");
  EXPECT_LE(control.at("relearning").at("pauses"), 2) << "one at the start, one at the limit";
}

TEST(TrackedFriction, IsNotToldAfterAFault) {
  const nlohmann::json control =
      summary_of("target_step", tracked({"sensor.force_gain=-1"})).at("control");
  EXPECT_FALSE(control.at("faults").empty());
  EXPECT_FALSE(control.contains("friction"));
}

}  // namespace
}  // namespace sonoglide::acceptance::tracked_friction_test
