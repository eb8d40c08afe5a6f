/// The test of the sample of "How to add a command".
#include <gtest/gtest.h>

#include "tests/acceptance/program/program.hpp"
#include "tests/common/csv/csv.hpp"

namespace sonoglide::acceptance::natural_mode_command_test {
namespace {

TEST(NaturalModeCommand, IsThatOfTheMassOnItsSpring) {
  const ScratchFolder folder;
  folder.write("scene.toml",
               "plant = {mass_kg = 0.04, stiffness_N_per_m = 133e6}\nfriction.law = 'none'\n"
               "sliding.velocity_m_per_s = 0.02\nrun.duration_s = 1e-3\n");
  EXPECT_EQ(folder.run("natural-mode scene.toml").exit_code, 0);
  const csv::Table table(folder.read("out/scene_natural_mode/natural_mode.csv"));
  EXPECT_NEAR(table.row_of("scene", "scene").number("natural_mode_Hz"), 9177.3217, 1e-3);
}

}  // namespace
}  // namespace sonoglide::acceptance::natural_mode_command_test
