#include "host_sim/process/scratch_folder.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
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
