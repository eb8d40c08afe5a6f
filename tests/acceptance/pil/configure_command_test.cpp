#include <gtest/gtest.h>

#include <string>

#include "host_sim/image/controller_header.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance {
namespace {

const std::string name = std::string("/") + image::controller_header_name;

TEST(ConfigureCommandTest, WritesTheHeaderOfAScene) {
  const ScratchFolder folder;
  const Outcome outcome = folder.run("configure '" SONOGLIDE_SCENES "/target_step.toml'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "header: out/target_step" + name + "\n");
  const std::string header = folder.read("out/target_step" + name);
  EXPECT_NE(header.find("inline constexpr TargetStep<Scalar> target_steps[]"), std::string::npos);
  EXPECT_EQ(folder.run("configure '" SONOGLIDE_SCENES "/target_step.toml' --out other --quiet").out,
            "");
  EXPECT_EQ(folder.read("other" + name), header);
}

TEST(ConfigureCommandTest, SaysWhereASceneHasNoController) {
  const ScratchFolder folder;
  const Outcome outcome = folder.run("configure '" SONOGLIDE_SCENES "/table_1_open_loop.toml'");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("table_1_open_loop.toml:1:1: controller: missing"), std::string::npos)
      << outcome.err;
  EXPECT_TRUE(folder.entries().empty());
}

}  // namespace
}  // namespace sonoglide::acceptance
