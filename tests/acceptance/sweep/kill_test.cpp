/// A sweep that is killed again and again ends with the same bytes as one that is left alone.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/acceptance/program/program.hpp"
#include "tests/acceptance/sweep/scenes/base_scenes.hpp"

namespace sonoglide::acceptance::kill_test {
namespace {

using Milliseconds = std::chrono::duration<double, std::milli>;

/// Starts the program in a folder, waits, kills it; true if it had ended by itself, well.
bool run_until_killed(const ScratchFolder& folder, std::vector<std::string> arguments,
                      const std::function<void()>& wait) {
  std::vector<char*> words;
  for (std::string& argument : arguments) {
    words.push_back(argument.data());
  }
  words.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    const int nowhere = open("/dev/null", O_WRONLY);
    if (chdir(folder.path().c_str()) == 0 && dup2(nowhere, STDOUT_FILENO) >= 0) {
      execv(SONOGLIDE_PROGRAM, words.data());
    }
    _exit(127);
  }
  wait();
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0) << WEXITSTATUS(status);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::vector<std::string> sweep_words(const std::string& out, const std::string& tolerance) {
  return {"sonoglide",  "sweep",
          "scene.toml", "--out",
          out,          "--quiet",
          "--threads",  "2",
          "--vary",     "velocity_ratio=0.05:1.2:20",
          "--vary",     "friction.contact_stiffness_N_per_m=1e4:1e6:40:log",
          "--set",      "solver.tolerance=" + tolerance};
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 1; i < words.size(); ++i) {
    text += words[i] + ' ';
  }
  return text;
}

/// Kills at random moments, until the sweep gets through; returns how often that took.
int sweep_under_kills(const ScratchFolder& folder, const std::vector<std::string>& words,
                      Milliseconds longest, std::mt19937& random) {
  constexpr int most_kills = 10;
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int kills = 0; kills < most_kills; ++kills) {
    const Milliseconds patience = longest * part(random);
    if (run_until_killed(folder, words, [&] { std::this_thread::sleep_for(patience); })) {
      return kills;
    }
  }
  EXPECT_EQ(folder.run(joined(words)).exit_code, 0);
  return most_kills;
}

void expect_the_same_after_kills(const std::string& tolerance) {
  const ScratchFolder folder;
  folder.write("scene.toml", open_loop_scene);
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(folder.run(joined(sweep_words("whole", tolerance))).exit_code, 0);
  const Milliseconds undisturbed = std::chrono::steady_clock::now() - begin;
  std::mt19937 random(7);
  int kills = 0;
  for (const std::string out : {"first", "second"}) {
    kills += sweep_under_kills(folder, sweep_words(out, tolerance), 0.8 * undisturbed, random);
    for (const char* file : {"/sweep.csv", "/sweep.svg", "/report.html"}) {
      EXPECT_EQ(without_command_line(folder.read(out + file)),
                without_command_line(folder.read(std::string("whole") + file)))
          << out << file;
    }
    EXPECT_EQ(folder.read(out + "/sweep.journal"), "");
  }
  testing::Test::RecordProperty("kills", kills);
}

TEST(KillTest, OnePointAtATime) {
  expect_the_same_after_kills("1e-10");
}

TEST(KillTest, ManyPointsAtATime) {
  expect_the_same_after_kills("1e-8");
}

class JournalLeftTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("scene.toml", open_loop_scene);
    const std::vector<std::string> words = {"sonoglide",
                                            "sweep",
                                            "scene.toml",
                                            "--out",
                                            "o",
                                            "--vary",
                                            "friction.coefficient=0.1:0.2:100",
                                            "--set",
                                            "run.duration_periods=2000",
                                            "--threads",
                                            "1"};
    ASSERT_FALSE(run_until_killed(folder_, words, [this] {
      constexpr int most_waits = 10000;
      for (int i = 0; i < most_waits && finished() < 2; ++i) {
        std::this_thread::sleep_for(Milliseconds(1.0));
      }
    }));
    ASSERT_GE(finished(), 2);
  }
  std::string journal() const { return folder_.read("o/sweep.journal"); }
  /// Points in it.
  std::ptrdiff_t finished() const {
    const std::string text = journal();
    return std::count(text.begin(), text.end(), '\n') - 1;
  }

  ScratchFolder folder_;
};

TEST_F(JournalLeftTest, IsRefusedByAnotherSweep) {
  const std::string before = journal();
  const auto refusal = [this](const std::string& arguments) {
    const Outcome outcome = folder_.run("sweep scene.toml --out o " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    return outcome.err;
  };
  EXPECT_NE(refusal("--vary friction.coefficient=0.1:0.2:100").find("of another scene; allowed: "),
            std::string::npos);
  EXPECT_NE(refusal("--vary friction.coefficient=0.1:0.2:101 --set run.duration_periods=2000")
                .find("of other --vary; allowed: "),
            std::string::npos);
  EXPECT_EQ(journal(), before);
}

TEST_F(JournalLeftTest, IsNotComputedAgain) {
  const std::ptrdiff_t before = finished();
  const Outcome outcome = folder_.run(
      "sweep scene.toml --out o --vary friction.coefficient=0.1:0.2:100 "
      "--set run.duration_periods=2000");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("100 points, " + std::to_string(before) + " of them finished before"),
            0U)
      << outcome.out;
}

}  // namespace
}  // namespace sonoglide::acceptance::kill_test
