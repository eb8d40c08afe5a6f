#include "host_sim/process/ending.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include "host_sim/process/child_process.hpp"
#include "host_sim/process/scratch_folder.hpp"

namespace sonoglide::process::ending_test {
namespace {

namespace fs = std::filesystem;

class EndingTest : public testing::Test {
 protected:
  EndingTest() {
    std::string name = testing::TempDir() + "ending_test_XXXXXX";
    home_ = mkdtemp(name.data());
    // Under nohup the tests start with a signal that is ignored.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      std::signal(signal, SIG_DFL);
    }
  }
  ~EndingTest() override { fs::remove_all(home_); }

  /// A process that watches for signals while it works.
  pid_t start(const std::function<void()>& work) const {
    const pid_t child = fork();
    if (child == 0) {
      const SignalWatch signals;
      work();
      _exit(0);
    }
    return child;
  }
  void say(const std::string& word) const { std::ofstream(home_ / word) << word; }
  bool is_said(const std::string& word) const {
    return comes_true([&] { return fs::exists(home_ / word); });
  }
  static bool comes_true(const std::function<bool()>& condition) {
    constexpr int most_looks = 6000;
    for (int i = 0; i < most_looks && !condition(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return condition();
  }
  static int end_of(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return status;
  }
  [[noreturn]] static void compute_for_good() {
    for (volatile int i = 0;; i = i + 1) {
    }
  }

  fs::path home_;
};

TEST_F(EndingTest, HearsASignalWhateverIsComputedAndUndoesTheNewestFirst) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const pid_t child = start([this] {
      const ScratchFolder outer(home_);
      const Undo inner([&] { fs::rename(outer.path() / "file", home_ / "undone"); });
      std::ofstream(outer.path() / "file") << "half";
      say("ready");
      compute_for_good();
    });
    ASSERT_TRUE(is_said("ready"));
    kill(child, signal);
    const int status = end_of(child);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal);
    EXPECT_TRUE(fs::remove(home_ / "undone"));
    fs::remove(home_ / "ready");
    EXPECT_TRUE(fs::is_empty(home_));
  }
}

TEST_F(EndingTest, EndsAToolAndWhatThatHasStarted) {
  const std::string ids = (home_ / "ids").string();
  const pid_t child = start([&] {
    run_tool({"sh", "-c",
              "sh -c 'echo $$ >" + ids + ".new; mv " + ids + ".new " + ids +
                  "; exec sleep 1000'; true"});
  });
  ASSERT_TRUE(is_said("ids"));
  pid_t grandchild = 0;
  std::ifstream(ids) >> grandchild;
  ASSERT_GT(grandchild, 0);
  kill(child, SIGTERM);
  EXPECT_TRUE(WIFSIGNALED(end_of(child)));
  EXPECT_EQ(kill(grandchild, 0), -1) << "it was waited for";
}

TEST_F(EndingTest, WaitsForWhatIsNotToBeDisturbed) {
  const pid_t child = start([this] {
    const Undisturbed now;
    say("ready");
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    say("done");
  });
  ASSERT_TRUE(is_said("ready"));
  kill(child, SIGTERM);
  end_of(child);
  EXPECT_TRUE(fs::exists(home_ / "done"));
}

TEST_F(EndingTest, LeavesAnIgnoredSignalIgnored) {
  std::signal(SIGINT, SIG_IGN);
  const pid_t child = start([this] {
    say("ready");
    while (!fs::exists(home_ / "go")) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  std::signal(SIGINT, SIG_DFL);
  ASSERT_TRUE(is_said("ready"));
  kill(child, SIGINT);
  say("go");
  const int status = end_of(child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

TEST_F(EndingTest, AnEndThatIsOverDoesNothing) {
  const pid_t child = start([this] {
    {
      const Undo undo([this] { say("undone"); });
    }
    say("ready");
    compute_for_good();
  });
  ASSERT_TRUE(is_said("ready"));
  kill(child, SIGTERM);
  end_of(child);
  EXPECT_FALSE(fs::exists(home_ / "undone"));
}

}  // namespace
}  // namespace sonoglide::process::ending_test
