#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/acceptance/program/page_words.hpp"
#include "tests/acceptance/program/program.hpp"
#include "tests/common/scenes.hpp"

namespace sonoglide::acceptance::run_output_test {
namespace {

using Entries = std::vector<std::string>;

const std::string open_loop = table_1_open_loop + R"([run]
duration_periods = 20
record = ["displacement_m"]
record_interval_s = 1e-6
)";

class RunOutputTest : public testing::Test {
 protected:
  void SetUp() override { folder_.write("scene.toml", open_loop); }

  std::string folder_name() const { return folder_.path().string(); }
  nlohmann::json echo(const std::string& summary) const {
    return nlohmann::json::parse(folder_.read(summary)).at("scene");
  }

  ScratchFolder folder_;
};

TEST_F(RunOutputTest, ASecondRunReplacesTheFirst) {
  EXPECT_EQ(folder_.run("run scene.toml --quiet").exit_code, 0);
  const Entries first = folder_.entries();
  EXPECT_EQ(folder_.run("run scene.toml --quiet --set friction.coefficient=0.2").exit_code, 0);
  EXPECT_EQ(folder_.entries(), first);
  EXPECT_EQ(echo("out/scene/summary.json").at("friction").at("coefficient"), 0.2);
}

TEST_F(RunOutputTest, SummaryAndPageSayWhatWasRun) {
  ASSERT_EQ(folder_
                .run("run scene.toml --quiet --set friction.coefficient=0.2 --set "
                     "'run.record=[]' --set friction.law=dahl")
                .exit_code,
            0);
  const auto program = nlohmann::json::parse(folder_.read("out/scene/summary.json")).at("program");
  EXPECT_EQ(program.at("version"), SONOGLIDE_VERSION);
  EXPECT_EQ(program.at("command_line"),
            "sonoglide run scene.toml --quiet --set friction.coefficient=0.2 --set "
            "'run.record=[]' --set friction.law=dahl");
  EXPECT_EQ(program.at("changed"), nlohmann::json::parse(R"({
    "friction.coefficient": {"file": 0.1, "value": 0.2},
    "run.record": {"file": ["displacement_m"], "value": []}})"));
  const std::string page = folder_.read("out/scene/report.html");
  for (
      const char* part :
      {"<dd><code><span>sonoglide</span> <span>run</span> <span>scene.toml</span> <span>--quiet</span> ",
       "<dd>sonoglide " SONOGLIDE_VERSION "</dd>",
       "<tr class=\"changed\"><td>friction.coefficient</td><td>0.2</td><td>changed; in the file: "
       "0.1</td></tr>"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(unexplained_symbols(page), std::vector<std::string>{});
}

TEST_F(RunOutputTest, NothingIsRecordedUnlessTheSceneAsks) {
  const Entries unrecorded{"out",
                           "out/scene",
                           "out/scene/.sonoglide",
                           "out/scene/report.html",
                           "out/scene/summary.json",
                           "scene.toml"};
  EXPECT_EQ(folder_.run("run scene.toml --quiet --set 'run.record=[]'").exit_code, 0);
  EXPECT_EQ(folder_.entries(), unrecorded);
  EXPECT_EQ(folder_.run("run scene.toml --quiet").exit_code, 0);
  EXPECT_EQ(folder_.run("run scene.toml --quiet --set 'run.record=[]'").exit_code, 0);
  EXPECT_EQ(folder_.entries(), unrecorded) << "the tables of an earlier run";
}

TEST_F(RunOutputTest, TablesHaveARowForEachSampleAndEachPeriod) {
  EXPECT_EQ(folder_.run("run scene.toml --quiet").exit_code, 0);
  const std::string trace = folder_.read("out/scene/trace.csv");
  const std::string periods = folder_.read("out/scene/periods.csv");
  EXPECT_EQ(trace.rfind("time_s,displacement_m\n0,0\n1e-06,", 0), 0U) << trace.substr(0, 60);
  EXPECT_EQ(std::count(trace.begin(), trace.end(), '\n'), 1 + 334);
  EXPECT_EQ(periods.rfind("time_s,friction_ratio,target,drive_amplitude_N,"
                          "sliding_velocity_m_per_s,limit\n0,",
                          0),
            0U);
  EXPECT_EQ(std::count(periods.begin(), periods.end(), '\n'), 1 + 20);
}

TEST_F(RunOutputTest, ATerminalIsToldHowLargeTheTablesWillBe) {
  const std::string command = shell_word(SONOGLIDE_PROGRAM) + " run scene.toml";
  const Outcome outcome = folder_.run_program("script", "-qec " + shell_word(command) + " said");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string said = "trace.csv and periods.csv: 334 and 20 rows, about ";
  const std::size_t at = outcome.out.find(said);
  ASSERT_NE(at, std::string::npos) << outcome.out;
  const double bytes = 1e6 * std::stod(outcome.out.substr(at + said.size()));
  const double true_bytes = static_cast<double>(folder_.read("out/scene/trace.csv").size() +
                                                folder_.read("out/scene/periods.csv").size());
  EXPECT_LT(std::abs(bytes - true_bytes), true_bytes / 3.0);
  EXPECT_EQ(folder_.run("run scene.toml").err, "");
}

TEST_F(RunOutputTest, OverridesReplaceAndAddAndTheLastOneWins) {
  const Outcome outcome = folder_.run(
      "run --quiet --set plant.mass_kg=1 --set plant.mass_kg=0.04 "
      "--set friction.sign_convention=as_printed --set solver.tolerance=1e-8 scene.toml");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json scene = echo("out/scene/summary.json");
  EXPECT_EQ(scene.at("plant").at("mass_kg"), 0.04);
  EXPECT_EQ(scene.at("friction").at("sign_convention"), "as_printed");
  EXPECT_EQ(scene.at("friction").at("normal_force_N"), 0.04 * 9.81) << "defaults follow overrides";
  EXPECT_EQ(scene.at("solver").at("tolerance"), 1e-8);
}

TEST_F(RunOutputTest, ABadSceneIsReportedBeforeABadFolder) {
  folder_.write("taken", "");
  EXPECT_EQ(folder_.run("run scene.toml --out taken --set plant.mass_kg=0").exit_code, 2);
}

TEST_F(RunOutputTest, AnInterruptedRunLeavesNothing) {
  // Hours of work, in the background of a shell; the signal comes once its hidden folder is there.
  const Outcome outcome = folder_.run(
      "run scene.toml --quiet --set run.duration_periods=1e9 --set run.record_interval_s=1e-4 & "
      "until ls -A '" +
      folder_name() +
      "' | grep -q '^[.]sonoglide-'; do sleep 0.01; done; "
      "kill -TERM $(cat /proc/$!/task/$!/children) $!; wait $!");
  constexpr int ended_by_term = 128 + 15;
  EXPECT_EQ(outcome.exit_code, ended_by_term);
  EXPECT_EQ(folder_.entries(), Entries{"scene.toml"});
}

TEST_F(RunOutputTest, AFailedComputationLeavesNothing) {
  // Far beyond the stability limit of the fixed step, 2.785 Fc / (Kt |V|).
  const Outcome outcome = folder_.run(
      "run scene.toml --set solver.method=rk4 --set solver.step_s=1.667e-8 "
      "--set friction.contact_stiffness_N_per_m=1e12");
  EXPECT_EQ(outcome.exit_code, 3);
  for (const char* part : {" s, ", "displacement", "velocity", "friction force"}) {
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(folder_.entries(), Entries{"scene.toml"});
}

}  // namespace
}  // namespace sonoglide::acceptance::run_output_test
