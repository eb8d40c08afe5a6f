#include "host_sim/scene_file/echo.hpp"

#include <gtest/gtest.h>

#include <string>

#include "host_sim/scene_file/scene_error.hpp"

namespace sonoglide::scene_file::changes_test {
namespace {

const Source source{"a.toml", "[plant]\nmass_kg = 0.02\nstiffness_N_per_m = 1e6\n"};

std::string told(const std::vector<std::string>& overrides) {
  return changes(source, overrides).dump();
}

TEST(ChangesTest, NothingSetNothingChanged) {
  EXPECT_EQ(told({}), "{}");
  EXPECT_EQ(told({"plant.mass_kg=2e-2"}), "{}");
}

TEST(ChangesTest, SaysWhatTheFileHasAndWhatTheRunHas) {
  EXPECT_EQ(told({"plant.mass_kg=0.03", "friction.law=dahl", "plant.stiffness_N_per_m="}),
            R"({"plant.mass_kg":{"file":0.02,"value":0.03},)"
            R"("friction.law":{"file":null,"value":"dahl"},)"
            R"("plant.stiffness_N_per_m":{"file":1000000.0,"value":null}})");
}

TEST(ChangesTest, TheLastOfSeveralValuesCounts) {
  EXPECT_EQ(told({"plant.mass_kg=0.03", "plant.mass_kg=0.04"}),
            R"({"plant.mass_kg":{"file":0.02,"value":0.04}})");
  EXPECT_EQ(told({"plant.mass_kg=0.03", "plant.mass_kg=0.02"}), "{}");
}

TEST(ChangesTest, RefusesWhatADocumentRefuses) {
  EXPECT_THROW(told({"plant.mas_kg=1"}), SceneError);
}

}  // namespace
}  // namespace sonoglide::scene_file::changes_test
