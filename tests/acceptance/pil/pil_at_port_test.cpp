// A board at a serial device: an emulator, whose serial line is a pseudo-terminal.
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/process/child_process.hpp"
#include "host_sim/process/pipe.hpp"
#include "image_cache.hpp"
#include "tests/acceptance/program/program.hpp"
#include "tests/host_sim/boards/unit/terminal/pseudo_terminal.hpp"

namespace sonoglide::acceptance::pil_at_port_test {
namespace {

const std::string scene = "'" SONOGLIDE_SCENES "/target_step.toml'";

/// A board that holds an image.
class Board {
 public:
  explicit Board(const std::string& image)
      : said_(process::make_pipe()), emulator_(command(image), streams(), SIGKILL) {
    said_.write_end.close();
  }

  /// Of its serial line, which the emulator names once it is there.
  std::string device() const {
    std::string text;
    char byte = 0;
    while (text.find(" (label") == std::string::npos &&
           read(said_.read_end.number(), &byte, 1) == 1) {
      text += byte;
    }
    const std::size_t begin = text.find("/dev/pts/");
    return begin == std::string::npos ? text : text.substr(begin, text.find(' ', begin) - begin);
  }

 private:
  static std::vector<std::string> command(const std::string& image) {
    std::vector<std::string> words =
        emulated::emulator_command(*emulated::find_board("mps2-an386"), image);
    words.insert(words.end(), {"-serial", "pty"});
    return words;
  }
  process::Streams streams() const {
    return {STDIN_FILENO, said_.write_end.number(), said_.write_end.number()};
  }

  process::Pipe said_;
  process::ChildProcess emulator_;
};

class PilAtPortTest : public testing::Test {
 protected:
  PilAtPortTest() { use_image_cache(); }

  std::string built(const std::string& changes = "") const {
    const Outcome outcome = folder_.run("image " + scene + changes +
                                        " --board mps2-an386 --lockstep --quiet --out image.elf");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return (folder_.path() / "image.elf").string();
  }

  ScratchFolder folder_;
};

TEST_F(PilAtPortTest, EveryCommandIsTheWorkstations) {
  const Board board(built());
  const Outcome outcome = folder_.run("pil " + scene + " --port " + board.device());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("every drive command is the workstation's, bit for bit"),
            std::string::npos)
      << outcome.out;
  const auto pil =
      nlohmann::json::parse(folder_.read("out/target_step_on_board/summary.json")).at("pil");
  EXPECT_TRUE(pil.at("same_as_workstation"));
  EXPECT_TRUE(pil.at("flash_bytes").is_null());
  EXPECT_TRUE(pil.at("instructions_per_step").is_null()) << "this board's image has no counter";
}

TEST_F(PilAtPortTest, TheImageOfAnotherSceneIsTold) {
  const Board board(built(" --set 'controller.target_friction_ratio=[[0.0,0.3]]'"));
  const Outcome outcome = folder_.run("pil " + scene + " --quiet --port " + board.device());
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("gave other drive commands"), std::string::npos) << outcome.err;
}

TEST_F(PilAtPortTest, OfASilentBoardItIsSaidWhatToDo) {
  const unit::PseudoTerminal silent;
  const Outcome outcome = folder_.run("pil " + scene + " --quiet --port " + silent.device());
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.err,
            silent.device() +
                ": carrier period 0: the board is silent for 10000 ms; reset the board, "
                "which must hold what image --lockstep builds of this scene\n");
  EXPECT_TRUE(folder_.entries().empty());
}

TEST_F(PilAtPortTest, WhatIsNoSerialDeviceIsRefused) {
  const Outcome unnamed = folder_.run("pil " + scene + " --port ''");
  EXPECT_EQ(unnamed.exit_code, 2);
  EXPECT_NE(unnamed.err.find("--port: is empty; allowed: a serial device\n"), std::string::npos)
      << unnamed.err;
  for (const char* device : {"/dev/null", "nothing_here"}) {
    const Outcome outcome = folder_.run("pil " + scene + " --port " + device);
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find(device), std::string::npos) << outcome.err;
    EXPECT_TRUE(folder_.entries().empty());
  }
}

}  // namespace
}  // namespace sonoglide::acceptance::pil_at_port_test
