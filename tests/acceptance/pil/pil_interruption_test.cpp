// A run on an emulated board that somebody ends: the program, or the emulator under it.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "host_sim/process/pipe.hpp"
#include "image_cache.hpp"
#include "tests/acceptance/program/started_program.hpp"
#include "tests/common/scenes.hpp"

namespace sonoglide::acceptance::pil_interruption_test {
namespace {

/// The target step of Table 1 over minutes.
const std::string long_scene = table_1_closed_loop + R"([run]
duration_s = 1000.0
[controller]
arithmetic = "float32"
target_friction_ratio = [[0.0, 0.4]]
)";

/// What /proc says of a process.
struct ProcessState {
  std::string program;
  char state = '\0';  ///< 0: there is no such process
  pid_t parent = 0;

  bool lives() const { return state != '\0' && state != 'Z'; }
};

ProcessState state_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(file, text);
  const std::size_t begin = text.find('(');
  const std::size_t end = text.rfind(')');
  ProcessState state;
  if (end != std::string::npos) {
    state.program = text.substr(begin + 1, end - begin - 1);
    std::istringstream(text.substr(end + 1)) >> state.state >> state.parent;
  }
  return state;
}

/// The emulator that a process has started; 0 where there is none.
pid_t emulator_of(pid_t parent) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") == std::string::npos) {
      const ProcessState state = state_of(std::stoi(name));
      if (state.parent == parent && state.program.rfind("qemu-system", 0) == 0) {
        return std::stoi(name);
      }
    }
  }
  return 0;
}

/// Processes whose command line has a text in it.
std::vector<std::string> processes_with(const std::string& text) {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::ifstream file(entry.path() / "cmdline", std::ios::binary);
    std::ostringstream read;
    read << file.rdbuf();  // nothing of a process that ends meanwhile
    const std::string line = read.str();
    if (line.find(text) != std::string::npos) {
      found.push_back(line);
    }
  }
  return found;
}

bool compiles(const std::vector<std::string>& processes) {
  return std::any_of(processes.begin(), processes.end(), [](const std::string& line) {
    return line.find("cc1plus") != std::string::npos;
  });
}

/// The program in the middle of a long run.
class PilInterruptionTest : public testing::Test {
 protected:
  PilInterruptionTest()
      : PilInterruptionTest(
            {"pil", "scene.toml", "--board", "mps2-an386", "--quiet", "--out", "out"}) {}
  explicit PilInterruptionTest(std::vector<std::string> arguments)
      : arguments_(std::move(arguments)) {
    use_image_cache();
  }
  void start() {
    folder_.write("scene.toml", long_scene);
    program_ = fork();
    if (program_ == 0) {
      become_the_program();
    }
  }
  void start_to_run() {
    start();
    ASSERT_TRUE(comes_true([this] { return (emulator_ = emulator_of(program_)) != 0; }));
  }
  ~PilInterruptionTest() override {
    if (program_ > 0) {
      kill(program_, SIGKILL);
      waitpid(program_, nullptr, 0);
    }
  }

  int end_of_the_program() {
    int status = 0;
    waitpid(program_, &status, 0);
    program_ = 0;
    return status;
  }
  bool emulator_is_gone() const {
    return comes_true([this] { return !state_of(emulator_).lives(); });
  }
  std::string errors() const { return folder_.read("errors"); }
  void expect_no_output() const {
    EXPECT_EQ(folder_.entries(), (std::vector<std::string>{"errors", "scene.toml"}));
  }

  ScratchFolder folder_;
  pid_t program_ = 0;
  pid_t emulator_ = 0;
  process::Pipe input_ = process::make_pipe();  ///< of the program

 private:
  [[noreturn]] void become_the_program() const {
    heed_signals();
    const int errors = open((folder_.path() / "errors").c_str(), O_WRONLY | O_CREAT, 0600);
    std::vector<const char*> words{"sonoglide"};
    for (const std::string& argument : arguments_) {
      words.push_back(argument.c_str());
    }
    words.push_back(nullptr);
    if (chdir(folder_.path().c_str()) == 0 && dup2(errors, STDERR_FILENO) >= 0 &&
        dup2(input_.read_end.number(), STDIN_FILENO) >= 0) {
      execv(SONOGLIDE_PROGRAM, const_cast<char* const*>(words.data()));
    }
    _exit(127);
  }

  std::vector<std::string> arguments_;
};

TEST_F(PilInterruptionTest, EndsInOrderOnCtrlCWhileTheImageIsBuilt) {
  const ScratchFolder cache;
  setenv("XDG_CACHE_HOME", cache.path().c_str(), 1);
  unsetenv("CMAKE_CXX_COMPILER_LAUNCHER");  // a cache of compilations leaves nothing to interrupt
  start();
  const auto builders = [&] { return processes_with(cache.path().string()); };
  ASSERT_TRUE(comes_true([&] { return compiles(builders()); }));
  kill(program_, SIGINT);
  EXPECT_TRUE(WIFSIGNALED(end_of_the_program()));
  EXPECT_TRUE(comes_true([&] { return builders().empty(); }));
  EXPECT_EQ(cache.entries(), std::vector<std::string>{"sonoglide"});
  expect_no_output();
}

TEST_F(PilInterruptionTest, EndsInOrderOnCtrlC) {
  start_to_run();
  kill(program_, SIGINT);
  const int status = end_of_the_program();
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGINT);
  EXPECT_TRUE(emulator_is_gone());
  expect_no_output();
}

TEST_F(PilInterruptionTest, EndsInOrderOnCtrlCWhileTheEmulatorHangs) {
  start_to_run();
  kill(emulator_, SIGSTOP);
  kill(program_, SIGINT);
  EXPECT_TRUE(WIFSIGNALED(end_of_the_program()));
  EXPECT_TRUE(emulator_is_gone());
  expect_no_output();
}

TEST_F(PilInterruptionTest, LeavesNoEmulatorWhenKilled) {
  start_to_run();
  kill(program_, SIGKILL);
  end_of_the_program();
  EXPECT_TRUE(emulator_is_gone());
}

TEST_F(PilInterruptionTest, ReportsAnEmulatorThatDies) {
  start_to_run();
  kill(emulator_, SIGKILL);
  const int status = end_of_the_program();
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_NE(errors().find("the emulator ended with signal 9"), std::string::npos) << errors();
  expect_no_output();
}

/// The program in the middle of a talk with the unit of an emulated board.
class ConnectInterruptionTest : public PilInterruptionTest {
 protected:
  ConnectInterruptionTest()
      : PilInterruptionTest({"connect", "scene.toml", "--emulated", "mps2-an386"}) {}
};

TEST_F(ConnectInterruptionTest, EndsInOrderWithItsInput) {
  start_to_run();
  const std::string lines = "restart\nstatus\n";
  ASSERT_GT(write(input_.write_end.number(), lines.data(), lines.size()), 0);
  input_.write_end.close();
  const int status = end_of_the_program();
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << errors();
  EXPECT_TRUE(emulator_is_gone());
  EXPECT_EQ(errors(), "");
  expect_no_output();
}

TEST_F(ConnectInterruptionTest, EndsInOrderOnCtrlC) {
  start_to_run();
  kill(program_, SIGINT);
  const int status = end_of_the_program();
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGINT);
  EXPECT_TRUE(emulator_is_gone());
  expect_no_output();
}

TEST_F(ConnectInterruptionTest, LeavesNoEmulatorWhenKilled) {
  start_to_run();
  kill(program_, SIGKILL);
  end_of_the_program();
  EXPECT_TRUE(emulator_is_gone());
}

TEST_F(ConnectInterruptionTest, ReportsAnEmulatorThatDies) {
  start_to_run();
  kill(emulator_, SIGKILL);
  const int status = end_of_the_program();
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1);
  EXPECT_NE(errors(), "");
  expect_no_output();
}

}  // namespace
}  // namespace sonoglide::acceptance::pil_interruption_test
