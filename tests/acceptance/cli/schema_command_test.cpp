/// `sonoglide schema`.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::schema_command_test {
namespace {

TEST(SchemaCommandTest, PrintsTheFileThatTheExamplesName) {
  std::ifstream file(SONOGLIDE_SCENES "/scene.schema.json", std::ios::binary);
  const std::string expected{std::istreambuf_iterator<char>(file),
                             std::istreambuf_iterator<char>()};
  const ScratchFolder folder;
  const Outcome outcome = folder.run("schema");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_FALSE(expected.empty());
  EXPECT_TRUE(outcome.out == expected);
  EXPECT_TRUE(folder.entries().empty());
}

}  // namespace
}  // namespace sonoglide::acceptance::schema_command_test
