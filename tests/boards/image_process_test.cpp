// What becomes of an emulator, and of who waits for it, when things go wrong.
#include "host_sim/boards/emulated/lockstep_image.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <stdexcept>
#include <string>
#include <vector>

#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/process/pipe.hpp"

namespace sonoglide::emulated::image_process_test {
namespace {

using std::chrono_literals::operator""s;
using std::chrono_literals::operator""ms;

std::vector<std::string> emulate(const std::string& image) {
  return emulated::emulator_command(*emulated::find_board("mps2-an386"), image);
}

std::vector<std::string> running() {
  return emulate(SONOGLIDE_IMAGES "/mps2-an386/bin/target_step.elf");
}

std::string failure(ImageProcess& board) {
  try {
    board.exchange(hal::Sample{});
  } catch (const ImageError& error) {
    return error.what();
  }
  return "";
}

bool alive(pid_t process) {
  return kill(process, 0) == 0;
}

TEST(ImageProcessTest, ReportsAnImageThatIsMissingInTheEmulatorsWords) {
  ImageProcess board(emulate("no_such_image"), 60s);
  const std::string words = failure(board);
  EXPECT_NE(words.find("carrier period 0: the emulator ended with exit code 1"), std::string::npos)
      << words;
  EXPECT_NE(words.find("'no_such_image'"), std::string::npos) << words;
}

TEST(ImageProcessTest, ReportsAnEmulatorThatIsMissing) {
  try {
    const ImageProcess board({"no_such_emulator"}, 60s);
    FAIL();
  } catch (const process::ProcessError& error) {
    EXPECT_EQ(error.what(),
              std::string("no_such_emulator: cannot be started: No such file or directory"));
  }
}

TEST(ImageProcessTest, ReportsAnEmulatorThatIsKilledInTheMiddle) {
  ImageProcess board(running(), 60s);
  board.exchange(hal::Sample{});
  board.exchange(hal::Sample{});
  kill(board.process(), SIGKILL);
  const std::string words = failure(board);
  EXPECT_NE(words.find("carrier period 2: the emulator ended with signal 9"), std::string::npos)
      << words;
}

TEST(ImageProcessTest, EndsAnEmulatorThatHangs) {
  ImageProcess board(running(), 500ms);
  const pid_t process = board.process();
  kill(process, SIGSTOP);
  EXPECT_NE(failure(board).find("hung for 500 ms"), std::string::npos);
  EXPECT_FALSE(alive(process));
}

TEST(ImageProcessTest, LeavesNoProcessBehind) {
  pid_t process = 0;
  {
    ImageProcess board(running(), 60s);
    board.exchange(hal::Sample{});
    process = board.process();
    EXPECT_TRUE(alive(process));
  }
  EXPECT_FALSE(alive(process));
}

}  // namespace
}  // namespace sonoglide::emulated::image_process_test
