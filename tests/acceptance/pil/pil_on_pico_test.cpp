// The image of a scene on the emulated Pico, where npm has installed the emulator.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "host_sim/process/regular_expression.hpp"
#include "image_cache.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::pil_on_pico_test {
namespace {

TEST(PilOnPicoTest, AScenesOwnImageHasTheWorkstationsCommands) {
  use_image_cache();
  const ScratchFolder folder;
  for (const char* samples : {"", " --set sensor.samples_per_period=4"}) {
    const Outcome outcome = folder.run(
        "pil '" SONOGLIDE_SCENES
        "/target_step_q31.toml' --board pico --set sensor.adc_bits=12 --set sensor.velocity_bits=12 "
        "--out out --quiet" +
        std::string(samples));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const nlohmann::json pil = nlohmann::json::parse(folder.read("out/summary.json")).at("pil");
    EXPECT_EQ(pil.at("same_as_workstation"), true);
    EXPECT_EQ(pil.at("board"), "pico");
    EXPECT_GT(pil.at("instructions_per_step").at("min"), 400);
    EXPECT_LE(pil.at("instructions_per_step").at("max"), 1900);
    EXPECT_GT(pil.at("stack_bytes_bound"), 100);
  }
}

TEST(ImageOnPicoTest, TellsClocksOfTheUnit) {
  use_image_cache();
  const ScratchFolder folder;
  const Outcome outcome =
      folder.run("image '" SONOGLIDE_SCENES "/target_step_q31.toml' --board pico");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const process::RegularExpression line(
      "step: ([0-9]+) clocks in the median, ([0-9]+) at most, of 2200 in a carrier");
  const process::Match clocks = line.search(outcome.out);
  ASSERT_FALSE(clocks.empty()) << outcome.out;
  EXPECT_GT(std::stoi(clocks[1]), 1000);
  EXPECT_LE(std::stoi(clocks[1]), std::stoi(clocks[2]));
  EXPECT_LT(std::stoi(clocks[2]), 2200);
}

}  // namespace
}  // namespace sonoglide::acceptance::pil_on_pico_test
