/// `sonoglide robust` from outside: files, figures, the worst plant, a kill, errors.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/acceptance/program/program.hpp"
#include "tests/acceptance/program/started_program.hpp"
#include "tests/common/scenes.hpp"

namespace sonoglide::acceptance::robust_command_test {
namespace {

using nlohmann::json;

const std::string uncertain = table_1_closed_loop + R"([solver]
tolerance = 1e-8
[run]
duration_s = 6e-3
[controller]
arithmetic = "float32"
target_friction_ratio = [[0.0, 0.4], [2e-3, 0.6], [4e-3, 0.5]]
[tolerance]
"plant.stiffness_N_per_m" = 0.04
)";

using Rows = std::vector<std::vector<std::string>>;

/// The cells of a table, its heading first.
Rows rows_of(const std::string& csv) {
  Rows rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) {
      rows.back().push_back(cell);
    }
  }
  return rows;
}

std::size_t column(const Rows& rows, const std::string& name) {
  const auto found = std::find(rows[0].begin(), rows[0].end(), name);
  EXPECT_NE(found, rows[0].end()) << name;
  return static_cast<std::size_t>(found - rows[0].begin());
}

class RobustCommandTest : public testing::Test {
 protected:
  void SetUp() override { folder_.write("uncertain.toml", uncertain); }
  Outcome run(const std::string& arguments) const { return folder_.run("robust " + arguments); }

  ScratchFolder folder_;
};

TEST_F(RobustCommandTest, HasARowForEachPlantAndTheirFigures) {
  const Outcome outcome =
      run("uncertain.toml --samples 64 --search 0 --out o "
          "--set tolerance.plant.stiffness_N_per_m=0.03");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("64 plants and 0 runs of the search\n64 loops in "), 0U)
      << outcome.out;
  const Rows rows = rows_of(folder_.read("o/robust.csv"));
  ASSERT_EQ(rows.size(), 65U);
  const json figures = json::parse(folder_.read("o/robust.json"));
  EXPECT_EQ(figures.at("samples"), 64);
  EXPECT_EQ(figures.at("failures"), 0);
  EXPECT_NEAR(figures.at("failure_probability_upper_95"), -std::expm1(std::log(0.05) / 64.0),
              1e-12);
  double largest = 0.0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    largest = std::max(largest, std::stod(rows[i][column(rows, "ripple")]));
    EXPECT_EQ(rows[i][column(rows, "failed")], "no");
  }
  EXPECT_EQ(figures.at("ripple").at("worst"), largest);
  for (const char* figure : {"settling_time_s", "overshoot", "steady_error", "ripple"}) {
    const json& found = figures.at(figure);
    EXPECT_LE(found.at("median"), found.at("p95")) << figure;
    EXPECT_LE(found.at("p95"), found.at("p99")) << figure;
    EXPECT_LE(found.at("p99"), found.at("worst")) << figure;
  }
  EXPECT_GT(figures.at("importance").at("plant.stiffness_N_per_m").at("ripple").at("main_effect"),
            0.8);
}

/// The loop of the row of worst.toml, to the last command of its controller and the last bit of every
/// figure.
void expect_the_same_loop(const ScratchFolder& folder, const std::string& out) {
  const json worst = json::parse(folder.read(out + "/robust.json")).at("worst");
  const Outcome outcome = folder.run("run " + out + "/worst.toml --out again --quiet");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json summary = json::parse(folder.read("again/summary.json"));
  const json& control = summary.at("control");
  EXPECT_EQ(control.at("trace_hash"), worst.at("trace_hash"));
  double settling_time_s = 0.0;
  double overshoot = 0.0;
  double steady_error = 0.0;
  double ripple = 0.0;
  bool settles = true;
  for (const json& step : control.at("steps")) {
    settles = settles && !step.at("settling_time_s").is_null();
    settling_time_s = settles ? std::max<double>(settling_time_s, step.at("settling_time_s")) : 0.0;
    overshoot = std::max<double>(overshoot, step.at("overshoot"));
    steady_error = std::max(steady_error, std::abs(step.at("steady_error").get<double>()));
    ripple = std::max<double>(ripple, step.at("ripple"));
  }
  EXPECT_EQ(worst.at("settling_time_s"), settles ? json(settling_time_s) : json());
  EXPECT_EQ(worst.at("overshoot"), overshoot);
  EXPECT_EQ(worst.at("steady_error"), steady_error);
  EXPECT_EQ(worst.at("ripple"), ripple);
  for (const auto& [key, value] : worst.at("factors").items()) {
    EXPECT_EQ(summary.at("scene").at("true_values").at(key), value);
  }
}

TEST_F(RobustCommandTest, TheWorstPlantRunsAgain) {
  ASSERT_EQ(run("uncertain.toml --samples 32 --search 48 --out o --quiet").exit_code, 0);
  const json worst = json::parse(folder_.read("o/robust.json")).at("worst");
  const double stiffness = worst.at("factors").at("plant.stiffness_N_per_m");
  EXPECT_TRUE(stiffness == 133e6 - 0.04 * 133e6 || stiffness == 133e6 + 0.04 * 133e6) << stiffness;
  expect_the_same_loop(folder_, "o");
}

/// At resonance, seen by its own current, and with a mass that sets the normal force by default.
TEST_F(RobustCommandTest, TakesAResonantTransducer) {
  ASSERT_EQ(
      run("'" SONOGLIDE_SCENES
          "/wire_bonder.toml' --samples 8 --search 8 --out o --quiet --set run.duration_s=3e-3 "
          "--set tolerance.transducer.force_factor_N_per_V=0.1 "
          "--set tolerance.plant.stiffness_N_per_m=0.01 "
          "--set tolerance.plant.mass_kg=0.001 --set tolerance.drive.frequency_Hz=1e-4 "
          "--set 'tolerance.sensor.seed={ range = [1, 1000] }' "
          "--set 'tolerance.transducer.clamped_capacitance_F={ normal = 0.05 }'")
          .exit_code,
      0);
  EXPECT_EQ(rows_of(folder_.read("o/robust.csv")).size(), 9U);
  expect_the_same_loop(folder_, "o");
}

TEST_F(RobustCommandTest, TheSeedSetsThePlantsAndTheThreadsNothing) {
  const auto tables = [&](const std::string& options) {
    EXPECT_EQ(run("- --samples 24 --search 24 --quiet --set run.duration_s=1e-3 --out o " +
                  options + " <uncertain.toml")
                  .exit_code,
              0);
    return folder_.read("o/robust.csv") + folder_.read("o/search.csv") +
           without_command_line(folder_.read("o/robust.json")) + folder_.read("o/worst.toml") +
           without_command_line(folder_.read("o/report.html"));
  };
  const std::string one = tables("--threads 1");
  EXPECT_EQ(tables("--threads 3"), one);
  EXPECT_EQ(tables("--seed 1"), one);
  EXPECT_NE(tables("--seed 2"), one);
}

TEST_F(RobustCommandTest, KilledItGoesOnWithTheSameFiles) {
  const std::vector<std::string> words = {
      "robust", "uncertain.toml", "--samples", "200", "--search", "20", "--quiet", "--out", "o"};
  ASSERT_EQ(run("uncertain.toml --samples 200 --search 20 --quiet --out whole").exit_code, 0);
  const ScratchFolder temporary;
  {
    StartedProgram program(folder_, words, temporary);
    ASSERT_TRUE(comes_true([&] {
      const std::string journal = folder_.read("o/robust.journal");
      return std::count(journal.begin(), journal.end(), '\n') > 20;
    }));
    program.send(SIGKILL);
    program.end();
  }
  const Outcome other = run("uncertain.toml --samples 201 --search 20 --quiet --out o");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("holds an unfinished study of other --samples, --search or --seed; "
                           "allowed: "),
            std::string::npos)
      << other.err;
  const Outcome again = run("uncertain.toml --samples 200 --search 20 --out o");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(again.out.find(" of them finished before\n"), std::string::npos) << again.out;
  for (const char* file :
       {"robust.csv", "search.csv", "robust.json", "worst.toml", "report.html"}) {
    EXPECT_EQ(without_command_line(folder_.read(std::string("o/") + file)),
              without_command_line(folder_.read(std::string("whole/") + file)))
        << file;
  }
  EXPECT_EQ(folder_.read("o/robust.journal"), "");
}

TEST_F(RobustCommandTest, InShardsItHasTheSameFiles) {
  const std::string study = "uncertain.toml --samples 50 --search 12 --seed 3 --quiet --out ";
  ASSERT_EQ(run(study + "whole").exit_code, 0);
  ASSERT_EQ(run(study + "o --shard 1/3").exit_code, 0);
  const Outcome incomplete = run("--merge o");
  EXPECT_EQ(incomplete.exit_code, 3);
  EXPECT_EQ(incomplete.out, "--array=2-3\n");
  EXPECT_EQ(run("--status o").out.find("1 of 3 shards are there, 0 begun; 16 of 50 points"), 0U);
  ASSERT_EQ(run(study + "o --slurm 3").exit_code, 0);
  for (const char* task : {"2", "3"}) {
    const std::string job = "SLURM_ARRAY_TASK_ID=" + std::string(task) + " bash " +
                            shell_word((folder_.path() / "o/robust.slurm").string());
    EXPECT_EQ(std::system(job.c_str()), 0) << folder_.read("o/slurm_2.log");
  }
  EXPECT_EQ(run("--merge o --quiet").exit_code, 0);
  for (const char* file :
       {"robust.csv", "search.csv", "robust.json", "worst.toml", "report.html"}) {
    EXPECT_EQ(without_command_line(folder_.read(std::string("o/") + file)),
              without_command_line(folder_.read(std::string("whole/") + file)))
        << file;
  }
  const Outcome foreign = folder_.run("sweep --merge o");
  EXPECT_EQ(foreign.exit_code, 2);
  EXPECT_NE(foreign.err.find("has kind robust, this command kind sweep"), std::string::npos);
}

TEST_F(RobustCommandTest, TellsTheNotesOfTheSceneOnce) {
  const std::string study =
      "uncertain.toml --samples 2 --search 2 --out o "
      "--set controller.shaping=robust";
  const Outcome outcome = run(study);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Outcome single = folder_.run("run uncertain.toml --set controller.shaping=robust --out s");
  EXPECT_EQ(outcome.err, single.err);
  EXPECT_EQ(outcome.err.find("note: The natural mode hardly decays."), 0U) << outcome.err;
  EXPECT_NE(folder_.read("o/report.html").find("The natural mode hardly decays."),
            std::string::npos);
  EXPECT_EQ(json::parse(folder_.read("o/robust.json")).at("notes").size(), 1U);
  EXPECT_EQ(run(study + " --quiet").err, "");
}

/// A step whose ratio still rings in its last periods has not settled, though it may be inside the
/// band at the very end by chance.
TEST_F(RobustCommandTest, CountsAPlantThatRingsUpToTheEnd) {
  const Outcome outcome = run("'" SONOGLIDE_SCENES
                              "/robust_step.toml' --samples 64 --search 0 --out o --set "
                              "tolerance.friction.coefficient= --set "
                              "tolerance.friction.contact_stiffness_N_per_m= --set "
                              "tolerance.sensor.velocity_gain= --set "
                              "tolerance.sensor.force_offset_N= --set "
                              "'tolerance.\"plant.stiffness_N_per_m\"=0.06'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Rows rows = rows_of(folder_.read("o/robust.csv"));
  int ringing = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double band = 0.01;
    if (std::stod(rows[i][column(rows, "ripple")]) > 1.1 * band) {
      ++ringing;
      EXPECT_EQ(rows[i][column(rows, "failed")], "yes") << i;
      EXPECT_EQ(rows[i][column(rows, "limits")], "not_settling") << i;
      EXPECT_EQ(rows[i][column(rows, "settling_time_s")], "nan") << i;
    }
  }
  EXPECT_GE(ringing, 10);
  EXPECT_NE(outcome.out.find("\n  limits: not_settling\n"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find(" never "), std::string::npos);
  EXPECT_NE(folder_.read("o/report.html").find("never"), std::string::npos);
}

TEST_F(RobustCommandTest, SaysOneOfOne) {
  const Outcome outcome = run("uncertain.toml --samples 1 --search 1 --out o");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("1 plant and 1 run of the search\n2 loops in "), 0U) << outcome.out;
}

TEST_F(RobustCommandTest, AFailureIsNamedAndCounted) {
  const Outcome outcome =
      run("uncertain.toml --samples 16 --search 0 --out o "
          "--set 'tolerance.sensor.force_gain={ range = [-1.5, -0.5] }' --set run.duration_s=2e-3");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json figures = json::parse(folder_.read("o/robust.json"));
  EXPECT_EQ(figures.at("failures"), 16);
  EXPECT_EQ(figures.at("failure_probability_upper_95"), 1.0);
  EXPECT_EQ(figures.at("with_fault"), 16);
  EXPECT_EQ(figures.at("faults").at("measurement_implausible"), 16);
  EXPECT_TRUE(figures.at("settling_time_s").at("median").is_null());
}

TEST_F(RobustCommandTest, RefusesWhatItCannotUse) {
  const auto refusal = [&](const std::string& arguments) {
    const std::vector<std::string> before = folder_.entries();
    const Outcome outcome = run(arguments + " --out o");
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_EQ(folder_.entries(), before) << arguments;
    return outcome.err;
  };
  EXPECT_EQ(
      refusal("uncertain.toml --set tolerance.plant.stiffness_N_per_m="),
      "uncertain.toml:20:2: tolerance: no key may vary; required: a table [tolerance] with at "
      "least one of them, such as \"plant.stiffness_N_per_m\" = 0.04\n");
  EXPECT_EQ(
      refusal("uncertain.toml --set 'tolerance.friction.coefficient={ normal = 0 }'")
          .find("--set:1:1: tolerance.friction.coefficient: 0 is out of range; allowed: above "
                "0, at most 100\n"),
      0U);
  // Half of the coefficients leave no room for the force that the contact begins with.
  EXPECT_NE(refusal("uncertain.toml --set friction.initial_force_N=0.0196 "
                    "--set tolerance.friction.coefficient=0.1")
                .find("uncertain.toml:20:2: tolerance: friction.initial_force_N: "),
            std::string::npos);
  EXPECT_NE(
      refusal("uncertain.toml --samples 0").find("\"0\"; allowed: a whole number, 1 to 1000000"),
      std::string::npos);
  EXPECT_NE(refusal("uncertain.toml --seed -1").find("allowed: a whole number, 0 to "),
            std::string::npos);
}

/// Other commands take the scene as it is, and say what it has.
TEST_F(RobustCommandTest, OtherCommandsRunTheScenesOwnPlant) {
  ASSERT_EQ(folder_.run("run uncertain.toml --out with --quiet").exit_code, 0);
  ASSERT_EQ(
      folder_
          .run("run uncertain.toml --out without --quiet --set tolerance.plant.stiffness_N_per_m=")
          .exit_code,
      0);
  const json with = json::parse(folder_.read("with/summary.json"));
  EXPECT_EQ(with.at("control").at("trace_hash"),
            json::parse(folder_.read("without/summary.json")).at("control").at("trace_hash"));
  EXPECT_EQ(with.at("scene").at("tolerance").at("plant.stiffness_N_per_m"), 0.04);
}

}  // namespace
}  // namespace sonoglide::acceptance::robust_command_test
