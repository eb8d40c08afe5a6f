// The image of a unit, built by one command: its file, what is told of it, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "host_sim/process/regular_expression.hpp"
#include "image_cache.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::image_command_test {
namespace {

namespace fs = std::filesystem;
using Entries = std::vector<std::string>;

std::string image_of(const std::string& scene, const std::string& board) {
  return "image '" SONOGLIDE_SCENES "/" + scene + ".toml' --board " + board;
}

std::uint32_t word(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i > 0; --i) {
    value = value << 8 | static_cast<unsigned char>(bytes[at + i - 1]);
  }
  return value;
}

/// The numbers of a line that begins so.
std::vector<long> numbers_of(const std::string& text, const std::string& begin) {
  const std::string line = text.substr(text.find(begin), text.find('\n', text.find(begin)));
  std::vector<long> found;
  const process::RegularExpression number("[0-9]+");
  for (const process::Match& each : number.search_all(line)) {
    found.push_back(std::stol(each[0]));
  }
  return found;
}

class ImageCommandTest : public testing::Test {
 protected:
  ImageCommandTest() { use_image_cache(); }

  Outcome built(const std::string& arguments) const {
    const Outcome outcome = folder_.run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << arguments << "\n" << outcome.err;
    return outcome;
  }

  /// Nothing is written.
  void expect_refused(const std::string& arguments, int exit_code,
                      const std::string& message) const {
    const Entries before = folder_.entries();
    const Outcome outcome = folder_.run(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << arguments;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << arguments << "\n" << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(folder_.entries(), before) << arguments;
  }

  ScratchFolder folder_;
};

TEST_F(ImageCommandTest, TellsSizeAndStepOfAUnitAndHowItIsRun) {
  const Outcome outcome = built(image_of("target_step", "mps2-an386"));
  const std::string file = "out/target_step_mps2-an386/unit.elf";
  EXPECT_NE(outcome.out.find("unit: " + file + ", for mps2-an386 (Cortex-M4F)\n"),
            std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("-serial pty"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("-kernel " + file + "\n"), std::string::npos) << outcome.out;
  EXPECT_EQ(folder_.read(file).substr(0, 4),
            "\x7f"
            "ELF");
  const std::vector<long> size = numbers_of(outcome.out, "size:");
  ASSERT_GE(size.size(), 3U);
  EXPECT_GT(size[0], 15'000);
  EXPECT_LT(size[0], 40'000);
  EXPECT_LT(size[1], 100);
  EXPECT_GT(size[2], 500);
  EXPECT_NE(outcome.out.find(" instructions in the median, "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find(" at most (not cycles), over the 360 steps"), std::string::npos);
  const std::vector<long> step = numbers_of(outcome.out, "step:");
  EXPECT_GT(step[0], 300);
  EXPECT_LE(step[0], step[1]);
  EXPECT_LT(step[1], 600);
}

TEST_F(ImageCommandTest, AQuietOneLeavesTheFileAlone) {
  const Outcome outcome =
      built(image_of("target_step", "mps2-an386") + " --quiet --out 'deep/a unit.elf'");
  EXPECT_EQ(outcome.out + outcome.err, "");
  EXPECT_EQ(folder_.entries(), (Entries{"deep", "deep/.sonoglide", "deep/a unit.elf"}));
  built(image_of("target_step", "mps2-an386") + " --quiet --out 'deep/a unit.elf'");
}

/// The .uf2 holds page by page what the .bin does.
TEST_F(ImageCommandTest, TheFilesOfAPicoHoldTheSame) {
  const std::string image = image_of("target_step_q31", "pico") + " --quiet --out ";
  built(image + "unit.uf2");
  built(image + "unit.bin");
  const std::string uf2 = folder_.read("unit.uf2");
  const std::string bin = folder_.read("unit.bin");
  constexpr std::size_t block = 512;
  constexpr std::size_t page = 256;
  constexpr std::size_t head = 32;
  constexpr std::uint32_t flash = 0x10000000;
  ASSERT_EQ(uf2.size() % block, 0U);
  ASSERT_GT(bin.size(), 10'000U);
  EXPECT_GE(uf2.size() / block * page, bin.size());
  for (std::size_t at = 0; at < uf2.size(); at += block) {
    const std::size_t place = word(uf2, at + 12) - flash;
    ASSERT_LT(place, bin.size());
    const std::string loaded = bin.substr(place, page);
    EXPECT_EQ(uf2.substr(at + head, loaded.size()), loaded) << place;
  }
}

TEST_F(ImageCommandTest, TheBytesOfANucleoBeginWithStackAndReset) {
  const Outcome outcome = built(image_of("target_step", "nucleo-g474re") + " --out unit.bin");
  EXPECT_NE(outcome.out.find("step: not known: no emulator"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("load: openocd "), std::string::npos);
  EXPECT_NE(outcome.out.find("-c 'program unit.bin 0x08000000 verify reset exit'\n"),
            std::string::npos)
      << outcome.out;
  EXPECT_EQ(numbers_of(outcome.out, "size:").size(), 3U) << outcome.out;
  const std::string bin = folder_.read("unit.bin");
  EXPECT_EQ(word(bin, 0) >> 24, 0x20U);
  EXPECT_EQ(word(bin, 4) >> 16, 0x0800U);
  EXPECT_EQ(word(bin, 4) & 1U, 1U);
}

TEST_F(ImageCommandTest, WhatCannotBeAUnitIsNamedByItsKey) {
  const std::string pico = image_of("target_step_q31", "pico");
  const std::string emulated = image_of("target_step", "mps2-an386");
  for (
      const auto& [arguments, message] : std::vector<std::pair<std::string, std::string>>{
          {image_of("table_1_open_loop", "pico"), ": controller: missing; required: "},
          {image_of("fingertip", "mps2-an386"), ": sensor.vibration: "},
          {image_of("target_step_float64", "pico2"), ": controller.arithmetic: "},
          {image_of("target_step", "pico"),
           ": controller.arithmetic: the pico has no time for floating point; allowed: \"q31\", \"q15\"\n"},
          {image_of("target_step_float64", "pico"),
           ": controller.arithmetic: the pico has no time for floating point; allowed: \"q31\", \"q15\"\n"},
          {image_of("damped_step", "mps2-an386"), ": sensor.vibration: "},
          {image_of("damped_step", "pico2"), ": sensor.vibration: "},
          {pico + " --set drive.frequency_Hz=59e3", "(pico); allowed: 6 MHz / n, n from 97 on\n"},
          {pico + " --set drive.delay_periods=2", "--set:1:1: drive.delay_periods: "},
          {pico + " --set drive.interpolation=linear", "--set:1:1: drive.interpolation: "},
          {pico + " --set controller.every_periods=2", "--set:1:1: controller.every_periods: "},
          {"image '" SONOGLIDE_SOURCE_TREE "/tests/boards/slow_mode.toml' --board nucleo-g474re",
           ": drive.bias_limit_N: "}}) {
    expect_refused(arguments + " --out unit.elf", 2, message);
  }
}

constexpr const char* textured =
    " --set controller.target_friction_ratio= --set 'controller.target_texture={ period_m = 1e-3, "
    "ratio = [0.5, 0.64, 0.7, 0.64, 0.5, 0.36, 0.3, 0.36] }'";

TEST_F(ImageCommandTest, ATextureMayLieAlongAnEncoder) {
  const std::string image = image_of("target_step", "nucleo-g474re") + textured + " --quiet";
  built(image + " --out sensed.bin");
  built(image + " --encoder 1e6 --out counted.bin");
  built(image + " --encoder 2e6 --out finer.bin");
  EXPECT_GT(folder_.read("counted.bin").size(), folder_.read("sensed.bin").size());
  EXPECT_NE(folder_.read("finer.bin"), folder_.read("counted.bin"));
  expect_refused(image + " --encoder 1e3 --out other.bin", 2,
                 ": controller.target_texture: the encoder of this board counts too little or too "
                 "much of a period_m; allowed: 8 to 2^30 counts (nucleo-g474re)");
}

TEST_F(ImageCommandTest, AnEncoderThatNothingReadsIsRefused) {
  const std::string image = image_of("target_step", "nucleo-g474re");
  expect_refused(image + " --encoder 1e6", 2,
                 "--encoder: the scene has no texture, which alone lies along an encoder; allowed: "
                 "controller.target_texture in the scene");
  expect_refused(image_of("target_step", "mps2-an386") + textured + " --encoder 1e6", 2,
                 "--encoder: mps2-an386 reads no encoder; allowed: --board nucleo-g474re");
  expect_refused(image_of("table_1_open_loop", "nucleo-g474re") + " --encoder 1e6", 2,
                 ": controller: missing; required: ");
  expect_refused(image + textured + " --encoder 0.5", 2, "--encoder: ");
  expect_refused(image + textured + " --encoder 1e6 --lockstep", 2, "excludes");
}

TEST_F(ImageCommandTest, KnowsBoardsAndTheFilesOfEach) {
  expect_refused(image_of("target_step", "uno"), 2,
                 "\"uno\" is no board; allowed: pico, pico2, nucleo-g474re, microbit, ");
  expect_refused(
      image_of("target_step", "mps2-an386") + " --out unit.uf2", 2,
      "\"unit.uf2\" is no file that mps2-an386 is loaded from; allowed: a name that ends "
      "in .elf\n");
  expect_refused(image_of("target_step", "nucleo-g474re") + " --out unit", 2, "in .elf, .bin\n");
  expect_refused(image_of("target_step_q31", "pico") + " --out ''", 2, "--out: is empty");
}

TEST_F(ImageCommandTest, WhatCannotBeWrittenEndsItBeforeItBuilds) {
  folder_.write("taken", "");
  folder_.write("unit.elf", "mine");
  const std::string image = image_of("target_step", "mps2-an386") + " --out ";
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder_.path().c_str(), 1);  // no tool is looked for yet
  expect_refused(image + "taken/unit.elf", 1, "taken: is a file, not a folder");
  expect_refused(image + "unit.elf", 1, "unit.elf");
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(folder_.read("unit.elf"), "mine");
}

TEST_F(ImageCommandTest, SaysWhichPackageHasTheCompiler) {
  const ScratchFolder tools;
  for (const char* tool : {"cmake", "ninja"}) {
    fs::create_symlink(std::string("/usr/bin/") + tool, tools.path() / tool);
  }
  const std::string path = std::getenv("PATH");
  setenv("PATH", tools.path().c_str(), 1);
  expect_refused(
      image_of("target_step", "nucleo-g474re"), 1,
      "arm-none-eabi-g++: is not installed; on Debian: apt-get install gcc-arm-none-eabi\n");
  expect_refused(image_of("target_step", "riscv32-virt"), 1, "gcc-riscv64-unknown-elf\n");
  setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace sonoglide::acceptance::image_command_test
