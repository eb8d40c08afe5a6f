// A controller as an image on an emulated board against the same controller on the workstation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "host_sim/boards/emulated/board_list.hpp"
#include "image_cache.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::pil_command_test {
namespace {

std::string scene_file(const std::string& scene) {
  return "'" SONOGLIDE_SCENES "/" + scene + ".toml'";
}

nlohmann::json summary_of(const ScratchFolder& folder, const std::string& arguments) {
  const Outcome outcome = folder.run(arguments + " --out out --quiet");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out + outcome.err, "");
  return outcome.exit_code == 0 ? nlohmann::json::parse(folder.read("out/summary.json"))
                                : nlohmann::json::object();
}

/// What differs from run to run, or is the image's alone.
nlohmann::json without_host(nlohmann::json summary) {
  summary.erase("run");
  summary.erase("pil");
  summary["control"].erase("signals");
  summary["program"].erase("command_line");
  return summary;
}

bool has_controller(const std::filesystem::path& scene) {
  std::ifstream file(scene);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return text.find("\n[controller]") != std::string::npos;
}

std::vector<std::string> closed_loop_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(SONOGLIDE_SCENES)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() == ".toml" && has_controller(entry.path()) &&
        name != "target_step_float64") {
      names.push_back(name);
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

class PilTest : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  PilTest() { use_image_cache(); }

  ScratchFolder host_;
  ScratchFolder board_;
};

TEST_P(PilTest, ComesToTheSameAsOnTheWorkstation) {
  const auto& [scene, board] = GetParam();
  const nlohmann::json host = summary_of(host_, "run " + scene_file(scene));
  const nlohmann::json pil = summary_of(board_, "pil " + scene_file(scene) + " --board " + board);
  ASSERT_TRUE(pil.contains("control"));
  EXPECT_EQ(pil.at("control").at("trace_hash"), host.at("control").at("trace_hash"));
  EXPECT_EQ(without_host(pil), without_host(host));
  EXPECT_EQ(board_.entries(), host_.entries());
  for (const char* table : {"out/trace.csv", "out/periods.csv"}) {
    EXPECT_EQ(board_.read(table), host_.read(table)) << table;
  }
}

INSTANTIATE_TEST_SUITE_P(EveryScene, PilTest,
                         testing::Combine(testing::ValuesIn(closed_loop_scenes()),
                                          testing::Values("mps2-an386")),
                         [](const auto& parameter) { return std::get<0>(parameter.param); });
INSTANTIATE_TEST_SUITE_P(OtherBoards, PilTest,
                         testing::Values(std::make_tuple("target_step", "riscv32-virt"),
                                         std::make_tuple("target_step_q31", "microbit"),
                                         std::make_tuple("target_step_float64", "mps2-an500")),
                         [](const auto& parameter) { return std::get<0>(parameter.param); });

class PilCommandTest : public testing::Test {
 protected:
  PilCommandTest() { use_image_cache(); }

  ScratchFolder folder_;
};

TEST_F(PilCommandTest, TellsWhatTheImageCosts) {
  const std::string command = "pil " + scene_file("target_step") + " --board mps2-an386";
  const nlohmann::json pil = summary_of(folder_, command).at("pil");
  EXPECT_EQ(pil.at("board"), "mps2-an386");
  EXPECT_GT(pil.at("exchanges_per_second"), 0.0);
  // A floating-point unit does a step in hundreds of instructions; the flash holds the map's table.
  const nlohmann::json& instructions = pil.at("instructions_per_step");
  EXPECT_GT(instructions.at("min"), 100);
  EXPECT_LE(instructions.at("min"), instructions.at("mean"));
  EXPECT_LE(instructions.at("mean"), instructions.at("max"));
  EXPECT_LT(instructions.at("max"), 2000);
  EXPECT_GT(pil.at("flash_bytes"), 3944);
  EXPECT_LT(pil.at("flash_bytes"), 20000);
  EXPECT_LT(pil.at("ram_bytes"), 1000);
  EXPECT_GT(pil.at("stack_bytes_bound"), 100);
  EXPECT_LT(pil.at("stack_bytes_bound"), 4096);
  EXPECT_EQ(summary_of(folder_, command).at("pil").at("instructions_per_step"), instructions);
}

TEST_F(PilCommandTest, ASoftwareStepCostsMore) {
  const auto mean = [this](const std::string& board) -> double {
    return summary_of(folder_, "pil " + scene_file("target_step") + " --board " + board)
        .at("pil")
        .at("instructions_per_step")
        .at("mean");
  };
  const double with_unit = mean("mps2-an386");
  EXPECT_EQ(mean("netduinoplus2"), with_unit);  // the same core, another clock
  EXPECT_GT(mean("riscv32-virt"), 3.0 * with_unit);
}

TEST_F(PilCommandTest, PrintsTheCostAndShowsItInTheReport) {
  const Outcome outcome = folder_.run("pil " + scene_file("target_step") + " --board mps2-an386");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("image on mps2-an386: "), std::string::npos) << outcome.out;
  EXPECT_NE(folder_.read("out/target_step_mps2-an386/report.html").find("Image on mps2-an386"),
            std::string::npos);
}

TEST_F(PilCommandTest, KnowsItsBoards) {
  const Outcome outcome = folder_.run("pil " + scene_file("target_step") + " --board uno");
  EXPECT_EQ(outcome.exit_code, 2);
  std::string allowed;
  for (const auto* boards : {&emulated::emulated_boards(), &emulated::carrier_boards()}) {
    for (const emulated::EmulatedBoard& board : *boards) {
      allowed += (allowed.empty() ? "" : ", ") + std::string(board.name);
    }
  }
  EXPECT_EQ(allowed.find("microbit, "), 0U);
  EXPECT_NE(outcome.err.find("\"uno\" is no board; allowed: " + allowed + "\n"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(folder_.run("pil " + scene_file("target_step")).exit_code, 2);
}

TEST_F(PilCommandTest, NeedsABoardThatComputesTheScenesArithmetic) {
  const Outcome outcome =
      folder_.run("pil " + scene_file("target_step_float64") + " --board mps2-an386");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find(": controller.arithmetic: float64 has no hardware on mps2-an386"),
            std::string::npos)
      << outcome.err;
  EXPECT_TRUE(folder_.entries().empty());
}

TEST_F(PilCommandTest, SaysWhatToInstall) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder_.path().c_str(), 1);
  const Outcome outcome = folder_.run("pil " + scene_file("target_step") + " --board riscv32-virt");
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.err,
            "qemu-system-riscv32: is not installed; on Debian: apt-get install qemu-system-misc\n");
}

const std::string for_pico = "pil " + scene_file("target_step_q31") +
                             " --board pico --set sensor.adc_bits=12 --set sensor.velocity_bits=12";

TEST_F(PilCommandTest, ThePicoRefusesWhatItDoesNotHave) {
  for (const auto& [setting, finding] : std::vector<std::pair<std::string, std::string>>{
           {"controller.arithmetic=float32", "has no time for floating point"},
           {"controller.every_periods=2", "steps in each carrier period; allowed: 1"},
           {"drive.delay_periods=2", "answers in the carrier period after the sampled one; "},
           {"drive.interpolation=linear", "holds the amplitude over a carrier period; "},
           {"sensor.adc_bits=14", "has converters of 12 bits; "},
           {"sensor.velocity_bits=", "has converters of 12 bits; "},
           {"sensor.samples_per_period=3",
            "converts the force four times in a carrier period; "}}) {
    const Outcome outcome = folder_.run(for_pico + " --set " + setting);
    EXPECT_EQ(outcome.exit_code, 2) << setting;
    EXPECT_NE(outcome.err.find(setting.substr(0, setting.find('=')) + ": the pico " + finding),
              std::string::npos)
        << outcome.err;
    EXPECT_TRUE(folder_.entries().empty());
  }
}

TEST_F(PilCommandTest, SaysWhatThePicoNeeds) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder_.path().c_str(), 1);
  const Outcome without_node = folder_.run(for_pico);
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(without_node.exit_code, 1);
  EXPECT_EQ(without_node.err, "node: is not installed; on Debian: apt-get install nodejs\n");

  const ScratchFolder sources;  // with nothing beside them
  std::filesystem::create_directory_symlink(SONOGLIDE_SOURCE_TREE "/firmware",
                                            sources.path() / "firmware");
  setenv("SONOGLIDE_SOURCE", sources.path().c_str(), 1);
  unsetenv("NODE_PATH");
  const Outcome without_package = folder_.run(for_pico);
  unsetenv("SONOGLIDE_SOURCE");
  EXPECT_EQ(without_package.exit_code, 1);
  EXPECT_EQ(without_package.err.rfind("rp2040js: the npm package that emulates a Pico is not", 0),
            0U)
      << without_package.err;
  EXPECT_EQ(std::count(without_package.err.begin(), without_package.err.end(), '\n'), 1);
}

TEST_F(PilCommandTest, RunsAControllerThatStepsOnceInSixteenPeriods) {
  const nlohmann::json summary =
      summary_of(folder_, "pil " + scene_file("target_step_q31") +
                              " --board microbit --set controller.every_periods=16");
  EXPECT_EQ(summary.at("pil").at("same_as_workstation"), true);
}

TEST_F(PilCommandTest, SaysWhereSourcesAreMissing) {
  setenv("SONOGLIDE_SOURCE", folder_.path().c_str(), 1);
  const Outcome outcome = folder_.run("pil " + scene_file("target_step") + " --board mps2-an386");
  unsetenv("SONOGLIDE_SOURCE");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("has no Sonoglide sources"), std::string::npos) << outcome.err;
  EXPECT_TRUE(folder_.entries().empty());
}

}  // namespace
}  // namespace sonoglide::acceptance::pil_command_test
