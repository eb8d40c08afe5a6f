#include "host_sim/process/output_folder.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "host_sim/process/file_error.hpp"

namespace sonoglide::process::output_folder_test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void put(const fs::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

using Names = std::set<std::string>;

/// What stands in an output folder beside its files.
const std::string list = ".sonoglide";

/// Files that an earlier run left in a folder.
void put_by_us(const fs::path& folder, const Names& names, const std::string& text) {
  OutputFolder output(folder);
  for (const std::string& name : names) {
    output.write(name, text);
  }
  output.commit();
}

class OutputFolderTest : public ::testing::Test {
 protected:
  OutputFolderTest() {
    std::string name = ::testing::TempDir() + "sonoglide_output_XXXXXX";
    root_ = fs::canonical(mkdtemp(name.data()));
  }
  ~OutputFolderTest() override { fs::remove_all(root_); }

  fs::path root_;
};

template <typename Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const process::FileError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST_F(OutputFolderTest, NewFolderAppearsAtCommitAndWhole) {
  const fs::path target = root_ / "out";
  {
    OutputFolder output(target);
    output.write("summary.json", std::string("{\0}", 3));
    output.open("trace.csv") << "time_s\n" << 0.5 << '\n';
    EXPECT_FALSE(fs::exists(target));
    output.commit();
  }
  EXPECT_EQ(names_in(root_), Names{"out"});
  EXPECT_EQ(names_in(target), (Names{list, "summary.json", "trace.csv"}));
  EXPECT_EQ(text_of(target / "summary.json"), std::string("{\0}", 3));
  EXPECT_EQ(text_of(target / "trace.csv"), "time_s\n0.5\n");
}

TEST_F(OutputFolderTest, NewFolderHasTheUsualPermissions) {
  fs::create_directory(root_ / "plain");
  OutputFolder output(root_ / "out");
  output.commit();
  EXPECT_EQ(fs::status(root_ / "out").permissions(), fs::status(root_ / "plain").permissions());
}

TEST_F(OutputFolderTest, MissingParentsAreCreatedAtCommit) {
  OutputFolder output(root_ / "a" / "b" / "out");
  output.write("file", "text");
  EXPECT_FALSE(fs::exists(root_ / "a"));
  output.commit();
  EXPECT_EQ(text_of(root_ / "a" / "b" / "out" / "file"), "text");
}

TEST_F(OutputFolderTest, WithoutCommitNothingIsLeft) {
  put_by_us(root_ / "old", {"file"}, "before");
  {
    OutputFolder fresh(root_ / "a" / "out");
    fresh.write("file", "text");
    OutputFolder existing(root_ / "old");
    existing.open("file") << "after";
  }
  EXPECT_EQ(names_in(root_), Names{"old"});
  EXPECT_EQ(names_in(root_ / "old"), (Names{list, "file"}));
  EXPECT_EQ(text_of(root_ / "old" / "file"), "before");
}

TEST_F(OutputFolderTest, ExistingFolderKeepsItsOtherFiles) {
  put_by_us(root_, {"file"}, "before");
  put(root_ / "other", "kept");
  {
    OutputFolder output(root_);
    output.write("file", "after");
    output.write("added", "new");
    EXPECT_EQ(text_of(root_ / "file"), "before");
    output.commit();
  }
  EXPECT_EQ(names_in(root_), (Names{list, "added", "file", "other"}));
  EXPECT_EQ(text_of(root_ / "file"), "after");
  EXPECT_EQ(text_of(root_ / "other"), "kept");
}

TEST_F(OutputFolderTest, WithdrawnFilesGoWithTheCommit) {
  put_by_us(root_, {"file", "stale"}, "before");
  put(root_ / "other", "kept");
  {
    OutputFolder output(root_);
    output.write("file", "after");
    output.withdraw("stale");
    output.withdraw("never there");
    EXPECT_EQ(text_of(root_ / "stale"), "before");
    output.commit();
  }
  EXPECT_EQ(names_in(root_), (Names{list, "file", "other"}));
}

TEST_F(OutputFolderTest, AFileThatCannotBeReplacedUndoesTheOthers) {
  put_by_us(root_, {"a", "stale"}, "before");
  fs::create_directory(root_ / "c");
  {
    OutputFolder output(root_);
    output.write("a", "after");
    output.write("b", "new");
    output.write("c", "in the way");
    output.withdraw("stale");
    const std::string message = message_of([&] { output.commit(); });
    EXPECT_NE(message.find((root_ / "c").string() + ": Is a directory"), std::string::npos)
        << message;
  }
  EXPECT_EQ(names_in(root_), (Names{list, "a", "c", "stale"}));
  EXPECT_EQ(text_of(root_ / "a"), "before");
  put_by_us(root_, {"a"}, "again");
  EXPECT_EQ(text_of(root_ / "a"), "again") << "still known as ours";
}

TEST_F(OutputFolderTest, ACommitThatFailsInAForeignFolderLeavesNoList) {
  fs::create_directory(root_ / "c");
  {
    OutputFolder output(root_);
    output.write("c", "in the way");
    EXPECT_NE(message_of([&] { output.commit(); }), "nothing was thrown");
  }
  EXPECT_EQ(names_in(root_), Names{"c"});
}

TEST_F(OutputFolderTest, WhatIsSomebodyElsesIsNeitherReplacedNorRemoved) {
  put(root_ / "trace.csv", "mine");
  const auto refused = [&](const std::string& message) {
    EXPECT_EQ(message.find((root_ / "trace.csv").string() + ": was not written by an earlier run"),
              0U)
        << message;
  };
  refused(message_of([&] { OutputFolder(root_, {"summary.json", "trace.csv"}); }));
  refused(message_of([&] { OutputFolder(root_).write("trace.csv", "ours"); }));
  refused(message_of([&] { OutputFolder(root_).open("trace.csv"); }));
  refused(message_of([&] { OutputFolder(root_).withdraw("trace.csv"); }));
  EXPECT_EQ(names_in(root_), Names{"trace.csv"});
  EXPECT_EQ(text_of(root_ / "trace.csv"), "mine");
}

TEST_F(OutputFolderTest, WhatWasChangedSinceIsSomebodyElses) {
  put_by_us(root_, {"trace.csv", "report.html"}, "ours");
  put(root_ / "trace.csv", "mine");  // of the same length
  EXPECT_THROW(OutputFolder(root_, {"trace.csv"}), process::FileError);
  EXPECT_NO_THROW(OutputFolder(root_, {"report.html"}));
  fs::remove(root_ / "trace.csv");
  put_by_us(root_, {"trace.csv"}, "again");
  EXPECT_EQ(text_of(root_ / "trace.csv"), "again");
}

TEST_F(OutputFolderTest, AFileThatAppearsMeanwhileIsKept) {
  OutputFolder output(root_);
  output.write("file", "ours");
  output.withdraw("stale");
  put(root_ / "stale", "mine");
  EXPECT_THROW(output.commit(), process::FileError);
  EXPECT_EQ(text_of(root_ / "stale"), "mine");
  EXPECT_EQ(names_in(root_).count("file"), 0U);
}

TEST_F(OutputFolderTest, AForeignFileInTheListsPlaceIsKept) {
  OutputFolder output(root_);
  put(root_ / list, "mine\n");
  EXPECT_THROW(OutputFolder(root_, {}), process::FileError) << "before anything is computed";
  output.write("file", "ours");
  EXPECT_THROW(output.commit(), process::FileError);
  EXPECT_EQ(text_of(root_ / list), "mine\n");
}

/// A run that is killed between any two of the moves of its commit.
TEST_F(OutputFolderTest, ACommitThatIsCutOffLeavesWhatTheNextRunReplaces) {
  put_by_us(root_, {"a", "b", "c"}, "first");
  const std::string old_list = text_of(root_ / list);
  put_by_us(root_, {"a", "b", "c"}, "second");
  for (const char* last : {"", "a", "b", "c"}) {
    for (const char* name : {"a", "b", "c"}) {
      put(root_ / name, std::string(name) <= last ? "second" : "first");
    }
    EXPECT_NO_THROW(OutputFolder(root_, {"a", "b", "c"})) << last;
  }
  EXPECT_NE(old_list, text_of(root_ / list));
}

TEST_F(OutputFolderTest, AFolderMadeMeanwhileIsFilledNotReplaced) {
  OutputFolder output(root_ / "out");
  output.write("file", "text");
  fs::create_directory(root_ / "out");
  put(root_ / "out" / "other", "kept");
  output.commit();
  EXPECT_EQ(names_in(root_ / "out"), (Names{list, "file", "other"}));
}

TEST_F(OutputFolderTest, TargetsThatCannotBeWrittenAreRefusedAtOnce) {
  put(root_ / "file", "text");
  fs::create_symlink(root_ / "nowhere", root_ / "dangling");
  for (const char* name : {"file", "file/out", "dangling", "dangling/out"}) {
    const std::string message = message_of([&] { OutputFolder output(root_ / name); });
    EXPECT_EQ(message.find(root_.string()), 0U) << message;
  }
  EXPECT_THROW(OutputFolder(""), process::FileError);
  EXPECT_THROW(OutputFolder("/proc/sonoglide/out"), process::FileError);
  EXPECT_EQ(names_in(root_), (Names{"dangling", "file"}));
}

TEST_F(OutputFolderTest, TargetMayEndInASeparatorOrALink) {
  fs::create_directory(root_ / "real");
  fs::create_directory_symlink(root_ / "real", root_ / "link");
  {
    OutputFolder output(root_ / "link" / "");
    output.write("file", "text");
    output.commit();
  }
  EXPECT_EQ(names_in(root_ / "real"), (Names{list, "file"}));
  EXPECT_EQ(names_in(root_), (Names{"link", "real"}));
}

TEST_F(OutputFolderTest, DotsAfterALinkMeanWhereItLeads) {
  fs::create_directories(root_ / "deep" / "real");
  fs::create_directory_symlink(root_ / "deep" / "real", root_ / "link");
  OutputFolder output(root_ / "link" / ".." / "out");
  output.commit();
  EXPECT_TRUE(fs::exists(root_ / "deep" / "out"));
}

/// Files may not grow past a limit, as on a disk that is full.
class FullDisk {
 public:
  FullDisk() {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit small = before_;
    small.rlim_cur = 4096;
    setrlimit(RLIMIT_FSIZE, &small);
    std::signal(SIGXFSZ, SIG_IGN);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, SIG_DFL);
  }

 private:
  rlimit before_{};
};

/// At once and with the reason, whether a file is written whole or piece by piece.
TEST_F(OutputFolderTest, AWriteThatTheSystemRefusesIsReported) {
  const FullDisk limited;
  {
    OutputFolder output(root_ / "out");
    const std::string whole =
        message_of([&] { output.write("report.html", std::string(100000, 'x')); });
    const std::string streamed = message_of([&] {
      std::ostream& trace = output.open("trace.csv");
      for (int i = 0; i < 100000; ++i) {
        trace << i << '\n';
      }
      ADD_FAILURE() << "the stream went on";
    });
    std::ostream& few = output.open("few.csv");
    few << std::string(5000, 'x');
    const std::string committed = message_of([&] { output.commit(); });
    for (const std::string& message : {whole, streamed, committed}) {
      EXPECT_NE(message.find("could not be written in full: File too large"), std::string::npos)
          << message;
    }
    EXPECT_EQ(whole.find((root_ / "out/report.html").string()), 0U);
    EXPECT_EQ(streamed.find((root_ / "out/trace.csv").string()), 0U);
  }
  EXPECT_EQ(names_in(root_), Names{});
}

/// Runs a commit of three files of one content in each of so many processes at once.
/// @return those that failed
int failures_of_commits(const fs::path& target, int processes) {
  std::vector<pid_t> running;
  for (int i = 0; i < processes; ++i) {
    running.push_back(fork());
    if (running.back() == 0) {
      try {
        for (int round = 0; round < 5; ++round) {
          OutputFolder output(target, {"a", "b", "c"});
          for (const char* name : {"a", "b", "c"}) {
            output.write(name, std::to_string(i) + std::string(1000, ' '));
          }
          output.commit();
        }
        _exit(0);
      } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        _exit(1);
      }
    }
  }
  int failed = 0;
  for (const pid_t each : running) {
    int status = 0;
    waitpid(each, &status, 0);
    failed += status == 0 ? 0 : 1;
  }
  return failed;
}

/// One of them is the last, in every file, and none takes another's files for somebody else's.
TEST_F(OutputFolderTest, SeveralProgramsMayWriteToOneFolderAtOnce) {
  fs::create_directory(root_ / "there");
  put(root_ / "there" / "other", "mine");
  for (const char* target : {"fresh", "there"}) {
    EXPECT_EQ(failures_of_commits(root_ / target, 16), 0) << target;
    const std::string last = text_of(root_ / target / "a");
    EXPECT_EQ(text_of(root_ / target / "b"), last);
    EXPECT_EQ(text_of(root_ / target / "c"), last);
  }
  EXPECT_EQ(names_in(root_), (Names{"fresh", "there"}));
  EXPECT_EQ(names_in(root_ / "fresh"), (Names{list, "a", "b", "c"}));
  EXPECT_EQ(names_in(root_ / "there"), (Names{list, "a", "b", "c", "other"}));
}

TEST_F(OutputFolderTest, AListThatIsNoFileIsRefused) {
  put_by_us(root_ / "other", {"a"}, "ours");
  put(root_ / "a", "mine");
  const auto expect_refused = [&] {
    EXPECT_NE(message_of([&] { put_by_us(root_, {"a"}, "new"); }).find("is not a list of files"),
              std::string::npos);
    fs::remove(root_ / list);
  };
  ASSERT_EQ(mkfifo((root_ / list).c_str(), 0600), 0);
  expect_refused();
  for (const fs::path& linked : {fs::path("/dev/zero"), root_ / "other" / list}) {
    fs::create_symlink(linked, root_ / list);
    expect_refused();
  }
  EXPECT_EQ(text_of(root_ / "a"), "mine");
}

/// As programs do that have made them and fail.
TEST_F(OutputFolderTest, ParentsMayGoWhileTheyAreUsed) {
  std::atomic<bool> done{false};
  std::thread other([&] {
    while (!done) {
      std::error_code ignored;
      fs::create_directories(root_ / "a" / "b", ignored);
      fs::remove(root_ / "a" / "b", ignored);
      fs::remove(root_ / "a", ignored);
    }
  });
  for (int i = 0; i < 50; ++i) {
    const fs::path target = root_ / "a" / "b" / "c";
    EXPECT_NO_THROW(put_by_us(target, {"file"}, "new")) << i;
    EXPECT_EQ(text_of(target / "file"), "new") << i;
    fs::remove_all(target);
    EXPECT_NO_THROW(create_folder(target, {})) << i;
    fs::remove(target);
  }
  done = true;
  other.join();
}

TEST_F(OutputFolderTest, NamesArePlainAndUsedOnce) {
  OutputFolder output(root_ / "out");
  for (const char* name : {"", ".", "..", "a/b", "/a", "a/", "a\n"}) {
    EXPECT_THROW(output.write(name, ""), std::invalid_argument) << name;
  }
  output.write("file", "text");
  EXPECT_THROW(output.open("file"), std::invalid_argument);
  EXPECT_THROW(output.withdraw("file"), std::invalid_argument);
}

}  // namespace
}  // namespace sonoglide::process::output_folder_test
