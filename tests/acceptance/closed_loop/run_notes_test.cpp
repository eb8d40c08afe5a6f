/// What the simulation of a run sees and no controller says is told everywhere.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/acceptance/closed_loop/runs/closed_loop.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::run_notes_test {
namespace {

struct Told {
  std::string terminal;
  std::string before;  ///< on standard error
  nlohmann::json summary;
  std::string page;
};

Told run(const std::string& scene, const std::string& settings) {
  const ScratchFolder folder;
  const Outcome outcome =
      folder.run("run " SONOGLIDE_SCENES "/" + scene + ".toml --out out " + settings);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return {outcome.out, outcome.err, nlohmann::json::parse(folder.read("out/summary.json")),
          folder.read("out/report.html")};
}

/// A limit of a step, and by whom it is named.
bool names(const nlohmann::json& summary, const std::string& limit, const std::string& by) {
  for (const nlohmann::json& step : summary["control"]["steps"]) {
    if (step["limit"] == limit && step["limit_seen_by"] == by) {
      return true;
    }
  }
  return false;
}

// At 1500 N the amplitude is 1.51 of the one that opens the contact: open for acos(1/1.51)/pi.
TEST(RunNotesTest, AnOpenContactIsToldInOpenLoop) {
  const Told told = run("normal_open_loop", "--set drive.force_amplitude_N=1500");
  const double open = told.summary["contact"]["open_fraction"];
  EXPECT_NEAR(open, 0.2686, 1e-3);
  EXPECT_GT(told.summary["contact"]["mean_normal_force_N"].get<double>(), 3.2);
  EXPECT_NE(told.terminal.find("WARNING: The vibration opens the contact for 26.9 % of the time"),
            std::string::npos);
  EXPECT_NE(told.page.find("The vibration opens the contact for 26.9 %"), std::string::npos);
  const Told closed = run("normal_open_loop", "");
  EXPECT_EQ(closed.summary["contact"]["open_fraction"], 0.0);
  EXPECT_NEAR(closed.summary["contact"]["mean_normal_force_N"].get<double>(), 3.0, 1e-6);
  EXPECT_EQ(closed.terminal.find("WARNING"), std::string::npos);
}

// The controller knows what vibration opens the contact that it was designed for; this one has a load
// that is lighter.
TEST(RunNotesTest, AnOpenContactIsALimitInClosedLoop) {
  const Told told =
      run("normal_open_loop",
          "--set drive.force_amplitude_N= --set run.start= --set drive.max_force_amplitude_N=3000 "
          "--set controller.arithmetic=float64 --set 'controller.target_friction_ratio=[[0, 0.1]]' "
          "--set true_values.friction.normal_force_N=2.5");
  EXPECT_TRUE(names(told.summary, "contact_lost", "simulation")) << told.terminal;
  EXPECT_GT(told.summary["control"]["limited_periods"]["contact_lost"], 0);
  EXPECT_NE(told.terminal.find("contact_lost, not detected by the controller"), std::string::npos);
  EXPECT_NE(told.summary["control"]["notes"].dump().find("opens the contact"), std::string::npos);
}

// A ratio near 1 takes a vibration slower than the sliding, which quenches nothing.
TEST(RunNotesTest, ATargetInAnUnstableWindowIsToldBeforeAndNamedAfter) {
  const Told told = run(
      "squeal",
      "--set friction.law=lugre --set friction.fall_s_per_m= --set friction.rise_s3_per_m3= "
      "--set friction.coefficient=0.3 --set friction.static_coefficient=0.5 "
      "--set friction.stribeck_velocity_m_per_s=0.05 --set friction.contact_stiffness_N_per_m=1e6 "
      "--set sliding.velocity_m_per_s=0.03 --set plant.damping_N_s_per_m=2 "
      "--set plant.initial_displacement_m= "
      "--set drive.max_force_amplitude_N=3000 "
      "--set 'controller.target_friction_ratio=[[0, 0.5], [1, 0.97]]'");
  EXPECT_NE(told.before.find("The target 0.97 at 0.03 m/s takes a drive of 190"), std::string::npos)
      << told.before;
  EXPECT_EQ(told.before.find("The target 0.5"), std::string::npos) << told.before;
  EXPECT_TRUE(names(told.summary, "self_excited", "simulation")) << told.terminal;
  EXPECT_EQ(told.summary["control"]["steps"][0]["limit"], "none");
  EXPECT_NE(told.page.find("self_excited"), std::string::npos);
}

// A cubic Stribeck contact has a least friction, here 0.0534 at 103 mm/s: feedback that finds the ratio above
// its target has driven beyond.
TEST(RunNotesTest, ADriveThatHasPassedTheLeastFrictionIsToldSo) {
  const std::string contact =
      "--set friction.law=stribeck --set friction.contact_stiffness_N_per_m= "
      "--set friction.fall_s_per_m=0.8 "
      "--set 'controller.target_friction_ratio=[[0, 0.5], [2e-3, 0.05]]' --set run.duration_s=4e-3 ";
  const Told passed = run("target_step", contact + "--set friction.rise_s3_per_m3=20");
  EXPECT_NE(passed.terminal.find("actuator (past the least friction: "), std::string::npos)
      << passed.terminal;
  const auto& least = passed.summary["control"]["steps"][1]["least_friction"];
  EXPECT_NEAR(least["ratio"].get<double>(), 0.05336, 1e-5);
  EXPECT_NEAR(least["vibration_m_per_s"].get<double>(), 0.1032, 1e-4);
  // Without a force sensor nothing drives it there: the vibration stands at the nearest ratio.
  const Told blind =
      run("target_step", contact +
                             "--set friction.rise_s3_per_m3=80 --set sensor.force=false "
                             "--set sensor.vibration=velocity "
                             "--set controller.vibration=damped");
  EXPECT_NE(blind.terminal.find("actuator (no vibration gives a ratio below 0.258)"),
            std::string::npos)
      << blind.terminal;
  EXPECT_TRUE(names(blind.summary, "actuator", "simulation"));
}

TEST(RunNotesTest, ACalibrationInAContactThatSticksAndSlipsIsTold) {
  const std::string told = "times that of steady sliding";
  const Told squealing = run("squeal", "--set controller.calibration_s=1");
  EXPECT_NE(squealing.terminal.find(told), std::string::npos) << squealing.terminal;
  EXPECT_NE(squealing.page.find(told), std::string::npos);
  EXPECT_EQ(run("noisy_sensor", "").terminal.find(told), std::string::npos);
}

TEST(RunNotesTest, ABiasIsToldWithWhatItTakesAway) {
  const Told told = run("damped_step",
                        "--set drive.bias_limit_N=4 --set plant.stiffness_N_per_m=2.5e6 "
                        "--set drive.max_force_amplitude_N=2000");
  EXPECT_NE(
      told.summary["control"]["notes"].dump().find("A bias force of up to 4 N takes the friction"),
      std::string::npos);
  EXPECT_EQ(told.summary["control"]["notes"].dump().find("no change of the amplitude"),
            std::string::npos);
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(RunNotesTest, ATextureThatIsMissedIsToldOnTheTerminalToo) {
  const Told fine =
      run("fingertip",
          "--set run.duration_s=0.02 "
          "--set 'controller.target_texture={ period_m = 3.5e-5, ratio = [0.6, 0.5] }'");
  for (const std::string& text : {fine.terminal, fine.page}) {
    EXPECT_TRUE(has(text, "first harmonic is 0.7")) << fine.terminal;
    EXPECT_TRUE(has(text, "more than 5 % or 20 degrees off")) << fine.terminal;
  }
  const Told longest =
      run("fingertip",
          "--set run.duration_s=0.005 "
          "--set 'controller.target_texture={ period_m = 1.0, ratio = [0.6, 0.5] }'");
  EXPECT_TRUE(has(longest.terminal, "WARNING: No whole period of the texture is passed"))
      << longest.terminal;
  EXPECT_TRUE(has(longest.terminal, "A period of 1 m takes a longer run.")) << longest.terminal;
}

TEST(RunNotesTest, ATargetThatARunCannotShowIsTold) {
  const std::string late = "The target 50 N at 0.5 s never begins: the run ends at 0.004 s.";
  const std::string faint = "The target 1e-06 N at 0 s is within the settling band of 5 N about 0";
  const Told force = run("belt_force",
                         "--set run.duration_s=4e-3 "
                         "--set 'controller.target_friction_force_N=[[0.0, 1e-6], [0.5, 50]]'");
  for (const std::string& text :
       {force.before, force.page, force.summary["control"]["notes"].dump()}) {
    EXPECT_TRUE(has(text, late)) << text.substr(0, 2000);
    EXPECT_TRUE(has(text, faint)) << text.substr(0, 2000);
  }
  const Told ratio = run(
      "target_step", "--set 'controller.target_friction_ratio=[[0.0, 0.4], [1.0, 0.5], [2, 0.6]]'");
  EXPECT_TRUE(has(ratio.before, "The target 0.5 at 1 s, like those after it, never begins"))
      << ratio.before;
  EXPECT_FALSE(has(ratio.before, "settling band")) << ratio.before;
  EXPECT_FALSE(has(run("target_step", "").before, "never begins"));
}

TEST(RunNotesTest, ALoadFasterThanAnyVelocityOfASceneIsNamed) {
  const std::string told =
      "The load reached 1.5e+06 m/s. No velocity of a scene may be beyond 1e+06 m/s";
  const std::string coulomb =
      "--set drive.voltage_amplitude_V=0 --set friction.law=coulomb "
      "--set friction.contact_stiffness_N_per_m= --set run.duration_s=0.15 ";
  const Told fast = run("seat_rail", coulomb + "--set 'load.force_profile_N=[[0.0, 1e9]]'");
  EXPECT_TRUE(has(fast.terminal, "WARNING: " + told)) << fast.terminal;
  EXPECT_TRUE(has(fast.page, told));
  const Told slow = run("seat_rail", coulomb + "--set 'load.force_profile_N=[[0.0, 6e8]]'");
  EXPECT_FALSE(has(slow.terminal, "The load reached")) << slow.terminal;
}

// The example says it: without vibration the seat yields by 2 um of 5.
TEST(RunNotesTest, ALoadThatSticksHasNoFrictionRatio) {
  const std::string told = "The contact sticks: the load moves within ";
  const Told stuck = run("seat_rail", "--set drive.voltage_amplitude_V=0");
  EXPECT_TRUE(has(stuck.terminal, told)) << stuck.terminal;
  EXPECT_TRUE(has(stuck.terminal, "yields by 5 um before it slides")) << stuck.terminal;
  EXPECT_FALSE(has(stuck.terminal, "friction ratio 0")) << stuck.terminal;
  EXPECT_TRUE(has(stuck.page, told));
  EXPECT_TRUE(has(stuck.page, "none: the contact sticks"));
  EXPECT_TRUE(stuck.summary["friction_ratio"]["window"].is_null());
  // Pushed harder than its friction it slides.
  const Told pushed = run("seat_rail",
                          "--set drive.voltage_amplitude_V=0 --set run.duration_s=0.3 "
                          "--set 'load.force_profile_N=[[0.1, 0.0], [0.2, 300.0]]'");
  EXPECT_FALSE(has(pushed.terminal, told)) << pushed.terminal;
  EXPECT_GT(pushed.summary["friction_ratio"]["whole_run"].get<double>(), 0.1);
}

/// How often a part is in a text.
int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

TEST(RunNotesTest, EachStepThatNeverSettlesIsToldOnThePage) {
  // 500 N are enough for 0.6 (437.7 N), not for 0.4 and 0.5.
  const Told short_of_force = run("target_step", "--set drive.max_force_amplitude_N=500");
  EXPECT_EQ(count(short_of_force.page,
                  "never settles: the friction ratio does not stay within "
                  "0.01 of the target"),
            2);
  EXPECT_NE(short_of_force.page.find("The step to 0.4 at 0 ms never settles"), std::string::npos);
  EXPECT_NE(short_of_force.page.find("The step to 0.5 at 4 ms never settles"), std::string::npos);
  EXPECT_NE(short_of_force.page.find("Limit: actuator."), std::string::npos);
  EXPECT_EQ(count(short_of_force.page, R"("line":"band")"), 1);
  // The sensor reads a tenth too much: only the simulation sees it.
  const Told blind = run("target_step",
                         "--set sensor.force_gain=1.1 --set "
                         "'controller.target_friction_ratio=[[0.0, 0.5]]'");
  EXPECT_TRUE(blind.summary["control"]["steps"][0]["settling_time_s"].is_null());
  EXPECT_EQ(count(blind.page, "The step to 0.5 at 0 ms never settles"), 1);
  EXPECT_NE(blind.page.find("not detected by the controller."), std::string::npos);
  EXPECT_EQ(count(run("target_step", "").page, "never settles"), 0);
}

// Noise and a stiffness that is 4 % off: the controller computes too small a current.
TEST(RunNotesTest, ATrueCurrentAboveItsLimitIsToldAndNamed) {
  const Told told =
      run("wire_bonder",
          "--set sensor.vibration_noise_m_per_s=1.4e-4 --set model_error.stiffness=0.961 --set "
          "drive.max_current_amplitude_A=0.01787");
  const double peak_A = told.summary["electrical"]["current_peak_A"];
  ASSERT_GT(peak_A, 1.02 * 0.01787);
  EXPECT_TRUE(names(told.summary, "current", "simulation")) << told.terminal;
  EXPECT_NE(told.terminal.find("WARNING: The current reached"), std::string::npos);
  EXPECT_NE(told.summary["control"]["notes"].dump().find("The current reached"), std::string::npos);
  EXPECT_NE(told.page.find("The current reached"), std::string::npos);
}

/// Ratio 0.5 ± 0.2 at the plate of haptic_plate.toml with Q 200, of a period that is passed so many times a
/// second.
Told run_texture(const std::string& period_m, const std::string& settings) {
  return run(
      "haptic_plate",
      "--set controller.target_friction_ratio= --set 'controller.target_texture={ period_m = " +
          period_m + ", ratio = [0.5, 0.64, 0.7, 0.64, 0.5, 0.36, 0.3, 0.36] }' " + settings);
}

TEST(RunNotesTest, ATextureIsToldByItsHarmonics) {
  const Told told = run_texture("1e-3", "--set run.duration_s=0.1");
  const nlohmann::json& control = told.summary["control"];
  EXPECT_TRUE(control["steps"].empty());
  EXPECT_GE(control["texture_periods"], 3);
  const nlohmann::json& mean = control["texture"][0];
  EXPECT_EQ(mean["harmonic"], 0);
  EXPECT_NEAR(mean["amplitude"].get<double>(), 0.5, 0.01);
  EXPECT_FALSE(mean.contains("phase_deg"));
  const nlohmann::json& first = control["texture"][1];
  EXPECT_EQ(first["harmonic"], 1);
  EXPECT_NEAR(first["target_phase_deg"].get<double>(), -90.0, 1e-6);
  EXPECT_NEAR(first["amplitude"].get<double>(), first["target_amplitude"].get<double>(), 0.01);
  EXPECT_NEAR(first["phase_deg"].get<double>(), -90.0, 5.0);
  EXPECT_NE(told.terminal.find("whole periods of it in the second half of the run"),
            std::string::npos);
  EXPECT_NE(told.page.find("Friction ratio over the sliding distance"), std::string::npos);
  EXPECT_EQ(told.before.find("texture"), std::string::npos);
}

TEST(RunNotesTest, ATextureThatIsTooSteepIsToldBeforeAndNamed) {
  const Told told =
      run_texture("0.08e-3", "--set run.duration_s=0.02 --set plant.damping_N_s_per_m=31.1");
  EXPECT_NE(told.before.find("the texture asks for changes of the vibration that are up to"),
            std::string::npos);
  EXPECT_NE(told.before.find("the limit voltage cuts them"), std::string::npos);
  EXPECT_GT(told.summary["control"]["limited_periods"]["voltage"], 50);
  EXPECT_NE(told.page.find("more than 5 % or 20 degrees off"), std::string::npos);
}

TEST(RunNotesTest, ATextureOfWhichNoPeriodIsPassedIsTold) {
  const Told told = run_texture("10e-3", "--set run.duration_s=0.01");
  EXPECT_TRUE(told.summary["control"]["texture"][1]["amplitude"].is_null());
  EXPECT_NE(told.page.find("No whole period of the texture is passed"), std::string::npos);
}

TEST(RunNotesTest, ATextureIsRefusedWhereTargetsHaveToStandStill) {
  const ScratchFolder folder;
  const Outcome outcome = folder.run("design " SONOGLIDE_SCENES "/fingertip.toml");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("controller.target_texture"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace sonoglide::acceptance::run_notes_test
