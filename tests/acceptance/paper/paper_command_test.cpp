/// `sonoglide paper` from outside.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/acceptance/program/page_words.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::paper_command_test {
namespace {

TEST(PaperCommand, OneFigureIsItsDataItsPictureAndThePage) {
  const ScratchFolder folder;
  const Outcome outcome = folder.run("paper --figure 3 --out out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "page: out/index.html\n");
  EXPECT_EQ(outcome.err, "") << "no progress bar on a pipe";
  EXPECT_EQ(folder.read("out/figure_03.csv").substr(0, 53),
            "time_s,coulomb_friction_force_N,dahl_friction_force_N");
  EXPECT_NE(folder.read("out/figure_03.svg").find("</svg>"), std::string::npos);
  EXPECT_NE(folder.read("out/index.html").find("Figure 3"), std::string::npos);
  EXPECT_EQ(folder.run("run out/table_1.toml --quiet").exit_code, 0);
}

TEST(PaperCommand, Figure12BringsTheMeasurementsAndItsScenes) {
  const ScratchFolder folder;
  ASSERT_EQ(folder.run("paper --figure 12 --out out --quiet").exit_code, 0);
  EXPECT_EQ(folder.read("out/measurements.csv").substr(0, 21), "source,doi,vibration,");
  EXPECT_EQ(unexplained_symbols(folder.read("out/index.html")), std::vector<std::string>{});
  for (const char* scene : {"table_2", "luo_2024", "table_1_coulomb", "table_1_dahl",
                            "table_1_lugre", "table_1_iwan", "table_1_stribeck"}) {
    EXPECT_EQ(folder.run("run out/" + std::string(scene) + ".toml --quiet").exit_code, 0) << scene;
  }
}

TEST(PaperCommand, BadUsageIsRejected) {
  const ScratchFolder folder;
  for (const char* arguments : {"paper --figure 1", "paper --figure 13", "paper --figure two"}) {
    const Outcome outcome = folder.run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_NE(outcome.err.find("sonoglide paper --help"), std::string::npos) << arguments;
  }
  EXPECT_TRUE(folder.entries().empty());
}

}  // namespace
}  // namespace sonoglide::acceptance::paper_command_test
