#include "host_sim/process/scratch_folder.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

namespace sonoglide::process::scratch_folder_test {
namespace {

namespace fs = std::filesystem;

class ScratchFolderTest : public testing::Test {
 protected:
  ScratchFolderTest() {
    std::string name = testing::TempDir() + "scratch_test_XXXXXX";
    home_ = mkdtemp(name.data());
  }
  ~ScratchFolderTest() override { fs::remove_all(home_); }

  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const fs::directory_entry& entry : fs::directory_iterator(home_)) {
      all.push_back(entry.path().filename().string());
    }
    std::sort(all.begin(), all.end());
    return all;
  }
  /// Another process makes such a folder and is killed in the middle of its work.
  void leave_an_orphan() const {
    const pid_t child = fork();
    if (child == 0) {
      const ScratchFolder folder(home_);
      fs::create_directories(folder.path() / "deep/inside");
      std::ofstream(folder.path() / "deep/file") << "half";
      kill(getpid(), SIGKILL);
    }
    waitpid(child, nullptr, 0);
  }

  fs::path home_;
};

TEST_F(ScratchFolderTest, GoesWithItsOwner) {
  {
    const ScratchFolder folder(home_);
    EXPECT_EQ(folder.path().filename().string().rfind(ScratchFolder::name_begin, 0), 0U);
    std::ofstream(folder.path() / "file") << "text";
    EXPECT_EQ(names().size(), 1U);
  }
  EXPECT_TRUE(names().empty());
}

TEST_F(ScratchFolderTest, TheNextOneClearsUpAfterTheKilled) {
  leave_an_orphan();
  ASSERT_EQ(names().size(), 1U);
  const std::string orphan = names().front();
  const ScratchFolder folder(home_);
  EXPECT_EQ(names(), std::vector<std::string>{folder.path().filename().string()});
  EXPECT_NE(folder.path().filename().string(), orphan);
}

TEST_F(ScratchFolderTest, TheLivingKeepTheirs) {
  const ScratchFolder first(home_);
  std::ofstream(first.path() / "file") << "text";
  { const ScratchFolder second(home_); }
  EXPECT_TRUE(fs::exists(first.path() / "file"));
}

/// Makes and drops folders beside others that do nothing but that, until the parent ends it.
[[noreturn]] void sweep_for_good(const fs::path& home) {
  while (true) {
    try {
      const ScratchFolder folder(home);
    } catch (const std::exception& error) {
      std::cerr << error.what() << '\n';
      _exit(1);
    }
  }
}

// A sweeper looks at a folder at every moment between its making and its end, an empty one or one
// with files in it. The owners are slowed by nothing but each other.
TEST_F(ScratchFolderTest, NobodyLosesItsFolderToASweeper) {
  constexpr int sweepers = 6;
  constexpr int owners = 200;
  std::vector<pid_t> sweeping;
  for (int i = 0; i < sweepers; ++i) {
    sweeping.push_back(fork());
    if (sweeping.back() == 0) {
      sweep_for_good(home_);
    }
  }
  std::vector<pid_t> owning;
  for (int i = 0; i < owners; ++i) {
    owning.push_back(fork());
    if (owning.back() == 0) {
      try {
        const ScratchFolder folder(home_);
        fs::create_directory(folder.path() / "new");
        std::ofstream(folder.path() / "new/file") << "text";
        _exit(fs::exists(folder.path() / "new/file") ? 0 : 2);
      } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        _exit(1);
      }
    }
  }
  for (const pid_t each : owning) {
    int status = 0;
    waitpid(each, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  }
  for (const pid_t each : sweeping) {
    int status = 0;
    kill(each, SIGKILL);
    waitpid(each, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
        << "a sweeper could make no folder";
  }
  { const ScratchFolder last(home_); }
  for (const std::string& name : names()) {
    // Of a sweeper that was killed before it had locked its folder.
    EXPECT_EQ(name.rfind(".sonoglide_new-", 0), 0U) << name;
  }
}

/// A folder that is made and not locked yet is no orphan, however empty.
TEST_F(ScratchFolderTest, AFolderThatIsBeingMadeStays) {
  fs::create_directory(home_ / ".sonoglide_new-abcdef");
  { const ScratchFolder folder(home_); }
  EXPECT_EQ(names(), std::vector<std::string>{".sonoglide_new-abcdef"});
}

/// Its owner was killed behind the last of its files.
TEST_F(ScratchFolderTest, AnEmptyFolderThatHasItsNameIsAnOrphan) {
  fs::create_directory(home_ / ".sonoglide-abcdef");
  { const ScratchFolder folder(home_); }
  EXPECT_TRUE(names().empty());
}

TEST_F(ScratchFolderTest, ARemovalThatIsCutShortLeavesAnOrphan) {
  leave_an_orphan();
  const fs::path orphan = home_ / names().front();
  fs::remove_all(orphan / "deep");
  { const ScratchFolder folder(home_); }
  EXPECT_TRUE(names().empty());
}

TEST_F(ScratchFolderTest, WhatOnlyLooksLikeOneStays) {
  fs::create_directories(home_ / ".sonoglide-abcdef/mine");
  fs::create_directories(home_ / ".sonoglide-longer-than-that");
  fs::create_directories(home_ / "elsewhere");
  fs::create_directory_symlink(home_ / "elsewhere", home_ / ".sonoglide-linked");
  std::ofstream(home_ / ".sonoglide-a_file") << "mine";
  const std::vector<std::string> before = names();
  { const ScratchFolder folder(home_); }
  EXPECT_EQ(names(), before);
}

TEST_F(ScratchFolderTest, SaysWhyItCannotBe) {
  try {
    const ScratchFolder folder(home_ / "no\nwhere");
    FAIL() << "made a folder in none";
  } catch (const ScratchError& error) {
    EXPECT_EQ(error.reason(), "No such file or directory");
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace sonoglide::process::scratch_folder_test
