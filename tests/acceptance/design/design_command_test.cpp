/// `sonoglide design` from outside.

#include <gtest/gtest.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/acceptance/program/page_words.hpp"
#include "tests/acceptance/program/program.hpp"
#include "tests/common/csv/csv.hpp"
#include "tests/common/scenes.hpp"

namespace sonoglide::acceptance::design_command_test {
namespace {

using Entries = std::vector<std::string>;

const std::string scene = table_1_closed_loop + R"([run]
duration_s = 6e-3
[controller]
arithmetic = "float32"
target_friction_ratio = [[0.0, 0.3], [2e-3, 0.5], [4e-3, 0.7]]
)";

void expect_scene_error(const std::string& options, const std::string& error) {
  ScratchFolder folder;
  folder.write("scene.toml", scene);
  const Outcome outcome = folder.run("design scene.toml " + options);
  EXPECT_EQ(outcome.exit_code, 2) << options;
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find(error), std::string::npos) << outcome.err;
  EXPECT_EQ(folder.entries(), Entries{"scene.toml"});
}

TEST(DesignCommand, HasTheKnownForcesInEveryOutput) {
  ScratchFolder folder;
  folder.write("scene.toml", scene);
  const Outcome outcome = folder.run("design scene.toml --velocity 0.02672:0.02672");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "") << "no progress bar on a pipe";
  EXPECT_NE(outcome.out.find("report: out/scene_design/report.html"), std::string::npos);
  const auto json = nlohmann::json::parse(folder.read("out/scene_design/design.json"));
  const double forces_N[] = {818.6, 526.3, 367.9};
  ASSERT_EQ(json["points"].size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(json["points"][i]["drive_force_N"].get<double>(), forces_N[i], 0.01 * forces_N[i]);
    EXPECT_EQ(json["points"][i]["limit"], "none");
  }
  const csv::Table design(folder.read("out/scene_design/design.csv"));
  EXPECT_EQ(design.rows().size(), 3U * 41);
  EXPECT_EQ(design.columns().at(2), "drive_force_N");
  const csv::Table detuning(folder.read("out/scene_design/detuning.csv"));
  EXPECT_EQ(detuning.columns().at(1), "tuning");
  EXPECT_NE(folder.read("out/scene_design/report.html").find("Design of scene"), std::string::npos);
  EXPECT_EQ(unexplained_symbols(folder.read("out/scene_design/report.html")), Entries{});
}

TEST(DesignCommand, TakesRatiosSpeedsAndOverridesFromTheCommandLine) {
  ScratchFolder folder;
  folder.write("scene.toml", scene);
  const Outcome outcome = folder.run(
      "design scene.toml --ratio 0.2 --velocity 0.01:0.1 --set plant.damping_N_s_per_m=10 "
      "--out here");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("UNREACHABLE: Ratio 0.2 at 100 mm/s"), std::string::npos);
  const auto json = nlohmann::json::parse(folder.read("here/design.json"));
  EXPECT_EQ(json["points"].size(), 2U);
  EXPECT_EQ(json["points"][1]["limit"], "actuator");
  EXPECT_EQ(json["scene"]["plant"]["damping_N_s_per_m"], 10.0);
}

TEST(DesignCommand, ContactsWithoutASteadyOrbitAreRejected) {
  expect_scene_error("--set friction.sign_convention=as_printed",
                     "--set:1:1: friction.sign_convention: is \"as_printed\"");
  expect_scene_error("--set drive.waveform=square", "--set:1:1: drive.waveform: ");
  expect_scene_error("--set 'friction.normal_force_profile_N=[[0,0.2],[1e-3,0.3]]'",
                     "--set:1:1: friction.normal_force_profile_N: a design is for a plant");
}

TEST(DesignCommand, ItsKeysCanBePastedBelowTheHeadersOfAScene) {
  ScratchFolder folder;
  folder.write("scene.toml", scene);
  const Outcome outcome = folder.run("design scene.toml --ratio 0.5 --velocity 0.02672:0.02672");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::size_t keys = outcome.out.find("\n[", outcome.out.find("\nKeys: ")) + 1;
  std::istringstream lines(outcome.out.substr(keys, outcome.out.find("\nController: ") + 1 - keys));
  std::string pasted = scene;
  std::string header;
  for (std::string line; std::getline(lines, line);) {
    if (line.front() == '[') {
      header = line + '\n';
    } else {
      pasted.insert(pasted.find(header) + header.size(), line + '\n');
    }
  }
  folder.write("pasted.toml", pasted);
  const Outcome run = folder.run("run pasted.toml --json");
  ASSERT_EQ(run.exit_code, 0) << pasted << run.err;
  const auto controller = nlohmann::json::parse(run.out)["scene"]["controller"];
  EXPECT_EQ(controller["vibration"], "damped") << pasted;
  EXPECT_EQ(controller["friction"], "calibrated");
}

// The range of a target is in its own unit.
TEST(DesignCommand, ATargetForceOutOfRangeIsToldInNewtons) {
  const ScratchFolder folder;
  const std::string belt =
      "design " SONOGLIDE_SCENES
      "/belt_force.toml --set friction.normal_force_profile_N= --set friction.normal_force_N=400 "
      "--set sliding.profile= --set sliding.velocity_m_per_s=0.1 --set ";
  for (const char* target : {"[[0.0,100]]", "[[0.0,1e-6]]"}) {
    const Outcome outcome =
        folder.run(belt + "'controller.target_friction_force_N=" + target + "'");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(
        outcome.err.find("controller.target_friction_force_N: no target to design for; allowed: at "
                         "least one of 0.1 N to below 100 N"),
        std::string::npos)
        << outcome.err;
  }
}

TEST(DesignCommand, ARatioIsNotShiftedByMoreThanItCanMove) {
  const ScratchFolder folder;
  const Outcome outcome = folder.run("design " SONOGLIDE_SCENES "/wire_bonder.toml");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("as far as it can move, to 0 or 1, more than the settling band"),
            std::string::npos)
      << outcome.out;
}

// The lowest ratio of this contact is about that of its closed form, and no force reaches 0.104.
TEST(DesignCommand, ARatioBelowTheLowestIsSoonFound) {
  ScratchFolder folder;
  folder.write("scene.toml", R"([plant]
mass_kg = 0.0232
stiffness_N_per_m = 382e6
damping_N_s_per_m = 195.0
[friction]
law = "stribeck"
coefficient = 0.203
normal_force_N = 0.564
fall_s_per_m = 1.275
rise_s3_per_m3 = 24.85
[sliding]
velocity_m_per_s = 0.0632
[drive]
frequency_Hz = 24211.0
max_force_amplitude_N = 291.0
[run]
duration_s = 6e-3
[controller]
arithmetic = "float32"
target_friction_ratio = [[0.0, 0.5]]
)");
  for (const char* ratio : {"0.102", "0.104", "0.105"}) {
    const Outcome outcome = folder.run("design scene.toml --ratio " + std::string(ratio));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("more vibration raises the friction again"), std::string::npos);
  }
}

TEST(DesignCommand, APlantWithoutASteadyVibrationFails) {
  ScratchFolder folder;
  folder.write("scene.toml", scene);
  const Outcome outcome = folder.run("design scene.toml --set plant.stiffness_N_per_m=0");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("steady orbit"), std::string::npos) << outcome.err;
  EXPECT_EQ(folder.entries(), Entries{"scene.toml"});
}

TEST(DesignCommand, BadUsageIsRejected) {
  for (const char* options : {"--ratio 0", "--ratio 1", "--ratio half", "--ratio nan",
                              "--velocity 0.1", "--velocity 0:0.1", "--velocity 0.2:0.1",
                              "--velocity 0.1:0.2:3", "--velocity nan:1", "--velocity 0.1:inf"}) {
    expect_scene_error(options, "sonoglide design --help");
  }
}

}  // namespace
}  // namespace sonoglide::acceptance::design_command_test
