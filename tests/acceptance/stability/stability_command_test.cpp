/// `sonoglide stability` from outside: what goes wrong is found before anything is computed.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance {
namespace {

using Entries = std::vector<std::string>;

TEST(StabilityCommand, HelpNamesItsOptionsAndFiles) {
  const ScratchFolder folder;
  const Outcome outcome = folder.run("stability --help");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  for (const char* part :
       {"--out", "--quiet", "report.html", "stability_map.csv", "extremes.csv"}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part;
  }
}

TEST(StabilityCommand, BadUsageIsRejected) {
  const ScratchFolder folder;
  for (const char* arguments :
       {"stability scene.toml", "stability --fast", "stability --out", "stability --out ''"}) {
    const Outcome outcome = folder.run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_NE(outcome.err.find("sonoglide --help"), std::string::npos) << arguments;
  }
  EXPECT_TRUE(folder.entries().empty());
}

TEST(StabilityCommand, AFileInTheWayIsFoundBeforeTheComputation) {
  const ScratchFolder folder;
  folder.write("taken", "");
  const Outcome outcome = folder.run("stability --out taken");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, folder.path().string() + "/taken: is a file, not a folder\n");
  EXPECT_EQ(folder.entries(), Entries{"taken"});
}

}  // namespace
}  // namespace sonoglide::acceptance
