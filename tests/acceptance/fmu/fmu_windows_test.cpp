/// The engine for Windows, under Wine: the commands of `run`, bit for bit.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>
#include <stdexcept>
#include <string>

#include "tests/acceptance/fmu/importer/description.hpp"
#include "tests/acceptance/fmu/importer/header_functions.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::fmu_windows_test {
namespace {

/// An example scene and what makes another of it.
struct Case {
  std::string name;
  std::string scene;
  std::string options;
};

void PrintTo(const Case& tested, std::ostream* out) {
  *out << tested.name;
}

TEST(FmuWindowsLibrary, ShowsTheFunctionsOfTheHeadersAndNeedsWindowsAlone) {
  const ScratchFolder folder;
  make_fmu(folder, SONOGLIDE_SCENES "/target_step.toml", "--kind loop", "fmu");
  const Outcome dump = folder.run_program("x86_64-w64-mingw32-objdump",
                                          "-p fmu/binaries/x86_64-windows/sonoglide_loop.dll");
  EXPECT_EQ(matches_of_lines(dump.out, "\\s+\\[ *[0-9]+\\] (fmi.*)"), header_functions());
  EXPECT_EQ(matches_of_lines(dump.out, "\\s+DLL Name: (.*)"),
            (std::set<std::string>{"KERNEL32.dll", "msvcrt.dll"}));
}

class FmuWindows : public testing::TestWithParam<Case> {};

TEST_P(FmuWindows, ALoopGivesTheHashOfRun) {
  const ScratchFolder folder;
  const std::string words = SONOGLIDE_SCENES "/" + GetParam().scene + ".toml " +
                            GetParam().options +
                            " --set 'run.record=[]' --set run.record_interval_s=";
  const Outcome ran = folder.run("run " + words + " --json");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const nlohmann::json summary = nlohmann::json::parse(ran.out);
  make_fmu(folder, words, "--kind loop", "fm\u00fc");
  const Description description(folder, "fm\u00fc");
  const double duration_s = summary["scene"]["run"]["duration_s"];
  const double steps = std::ceil(duration_s / description.step_s() - 1e-6);
  const std::string arguments =
      SONOGLIDE_STEP_LOOP
      " fm\u00fc/binaries/x86_64-windows/sonoglide_loop.dll fm\u00fc/resources " +
      shell_word(description.attribute("instantiationToken")) + " " +
      std::to_string(description.reference("trace_hash")) + " " +
      nlohmann::json(duration_s / steps).dump() + " " + std::to_string(std::lround(steps));
  // A prefix of its own, which Wine makes once.
  const Outcome stepped =
      folder.run_program("env", "WINEPREFIX=" SONOGLIDE_WINE_PREFIX
                                " WINEDEBUG=-all DISPLAY= LC_ALL=C.UTF-8 " SONOGLIDE_WINE " " +
                                    arguments);
  ASSERT_EQ(stepped.exit_code, 0) << stepped.err;
  EXPECT_EQ(stepped.out.substr(0, 16), summary["control"]["trace_hash"].get<std::string>());
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, FmuWindows,
    testing::Values(Case{"float32", "target_step", "--set solver.tolerance=1e-6"},
                    Case{"q31", "target_step_q31", "--set solver.tolerance=1e-6"},
                    Case{"damped", "damped_step", ""}, Case{"resonant", "wire_bonder", ""},
                    Case{"lugre", "target_step",
                         "--set friction.law=lugre --set friction.static_coefficient=0.12 --set "
                         "friction.stribeck_velocity_m_per_s=0.03 --set run.duration_s=1e-3"}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace sonoglide::acceptance::fmu_windows_test
