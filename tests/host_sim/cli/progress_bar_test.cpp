#include "host_sim/cli/progress_bar.hpp"

#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <cstdlib>
#include <limits>
#include <string>

namespace sonoglide::cli::progress_bar_test {
namespace {

/// A terminal that remembers what it was sent.
class Terminal {
 public:
  explicit Terminal(const char* name = "xterm", unsigned short columns = 0) {
    const winsize size{25, columns, 0, 0};
    EXPECT_EQ(openpty(&master_, &slave_, nullptr, nullptr, &size), 0);
    setenv("TERM", name, 1);
    stream_ = fdopen(slave_, "w");
  }
  ~Terminal() {
    std::fclose(stream_);
    close(master_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  std::FILE* stream() const { return stream_; }
  /// What was written so far, with an end mark that every terminal has seen.
  std::string written() const {
    std::fputs("|", stream_);
    std::fflush(stream_);
    std::string text;
    char c = '\0';
    while (c != '|' && read(master_, &c, 1) == 1) {
      text += c;
    }
    text.pop_back();
    return text;
  }

 private:
  int master_ = -1;
  int slave_ = -1;
  std::FILE* stream_ = nullptr;
};

TEST(ProgressLineTest, ShowsShareAndRemainingTime) {
  EXPECT_EQ(progress_line(0.0, 0.0), "[------------------------------]   0 %");
  EXPECT_EQ(progress_line(0.5, 3.0), "[###############---------------]  50 %, 3 s left");
  EXPECT_EQ(progress_line(0.1, 60.0), "[###---------------------------]  10 %, 9 min left");
  EXPECT_EQ(progress_line(0.01, 3600.0), "[------------------------------]   1 %, 99.0 h left");
  EXPECT_EQ(progress_line(1.0, 5.0), "[##############################] 100 %");
}

TEST(ProgressLineTest, TakesAnyNumber) {
  EXPECT_EQ(progress_line(-1.0, 1.0), progress_line(0.0, 1.0));
  EXPECT_EQ(progress_line(2.0, 1.0), progress_line(1.0, 1.0));
  EXPECT_EQ(progress_line(std::numeric_limits<double>::quiet_NaN(), 1.0), progress_line(0.0, 1.0));
}

TEST(ProgressLineTest, FitsItsTerminal) {
  EXPECT_EQ(progress_line(0.5, 3.0, 30), "[#####------]  50 %, 3 s left");
  EXPECT_EQ(progress_line(0.5, 3.0, 20), "[#####------]  50 %");
  EXPECT_EQ(progress_line(0.5, 3.0, 12), " 50 %");
  EXPECT_EQ(progress_line(0.5, 3.0, 3), "");
  for (int columns = 1; columns < 100; ++columns) {
    for (const double fraction : {0.0, 0.01, 0.5, 0.999, 1.0}) {
      for (const double elapsed_s : {0.0, 1.0, 1e3, 1e7}) {
        EXPECT_LT(static_cast<int>(progress_line(fraction, elapsed_s, columns).size()), columns);
      }
    }
  }
}

TEST(ProgressBarTest, AsksTheTerminalForItsWidth) {
  const Terminal terminal("xterm", 20);
  {
    ProgressBar bar(terminal.stream(), true);
    bar.update(0.0);
  }
  EXPECT_EQ(terminal.written(), "\r\x1b[K[-----------]   0 %\r\x1b[K");
}

TEST(ProgressBarTest, IsSilentWhereNoLineCanBeErased) {
  for (const char* name : {"dumb", ""}) {
    const Terminal terminal(name);
    {
      ProgressBar bar(terminal.stream(), true);
      bar.update(0.5);
    }
    EXPECT_EQ(terminal.written(), "");
  }
}

TEST(ProgressBarTest, DrawsOnATerminalAndClearsItself) {
  const Terminal terminal;
  {
    ProgressBar bar(terminal.stream(), true);
    bar.update(0.0);
  }
  EXPECT_EQ(terminal.written(), "\r\x1b[K" + progress_line(0.0, 0.0) + "\r\x1b[K");
}

TEST(ProgressBarTest, IsSilentOnATerminalWhereNotWanted) {
  const Terminal terminal;
  {
    ProgressBar bar(terminal.stream(), false);
    bar.update(0.5);
  }
  EXPECT_EQ(terminal.written(), "");
}

TEST(ProgressBarTest, IsSilentElsewhere) {
  std::FILE* file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  {
    ProgressBar bar(file, true);
    bar.update(0.5);
  }
  EXPECT_EQ(std::ftell(file), 0);
  std::fclose(file);
}

}  // namespace
}  // namespace sonoglide::cli::progress_bar_test
