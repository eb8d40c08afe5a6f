#include "host_sim/report/output_folder.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>

namespace sonoglide::report {
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
  } catch (const OutputError& error) {
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
  EXPECT_EQ(names_in(target), (Names{"summary.json", "trace.csv"}));
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
  fs::create_directory(root_ / "old");
  put(root_ / "old" / "file", "before");
  {
    OutputFolder fresh(root_ / "a" / "out");
    fresh.write("file", "text");
    OutputFolder existing(root_ / "old");
    existing.open("file") << "after";
  }
  EXPECT_EQ(names_in(root_), Names{"old"});
  EXPECT_EQ(names_in(root_ / "old"), Names{"file"});
  EXPECT_EQ(text_of(root_ / "old" / "file"), "before");
}

TEST_F(OutputFolderTest, ExistingFolderKeepsItsOtherFiles) {
  put(root_ / "file", "before");
  put(root_ / "other", "kept");
  {
    OutputFolder output(root_);
    output.write("file", "after");
    output.write("added", "new");
    EXPECT_EQ(text_of(root_ / "file"), "before");
    output.commit();
  }
  EXPECT_EQ(names_in(root_), (Names{"added", "file", "other"}));
  EXPECT_EQ(text_of(root_ / "file"), "after");
  EXPECT_EQ(text_of(root_ / "other"), "kept");
}

TEST_F(OutputFolderTest, WithdrawnFilesGoWithTheCommit) {
  put(root_ / "file", "before");
  put(root_ / "stale", "before");
  put(root_ / "other", "kept");
  {
    OutputFolder output(root_);
    output.write("file", "after");
    output.withdraw("stale");
    output.withdraw("never there");
    EXPECT_EQ(text_of(root_ / "stale"), "before");
    output.commit();
  }
  EXPECT_EQ(names_in(root_), (Names{"file", "other"}));
}

TEST_F(OutputFolderTest, AFileThatCannotBeReplacedUndoesTheOthers) {
  put(root_ / "a", "before");
  put(root_ / "stale", "before");
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
  EXPECT_EQ(names_in(root_), (Names{"a", "c", "stale"}));
  EXPECT_EQ(text_of(root_ / "a"), "before");
}

TEST_F(OutputFolderTest, AFolderMadeMeanwhileIsFilledNotReplaced) {
  OutputFolder output(root_ / "out");
  output.write("file", "text");
  fs::create_directory(root_ / "out");
  put(root_ / "out" / "other", "kept");
  output.commit();
  EXPECT_EQ(names_in(root_ / "out"), (Names{"file", "other"}));
}

TEST_F(OutputFolderTest, TargetsThatCannotBeWrittenAreRefusedAtOnce) {
  put(root_ / "file", "text");
  fs::create_symlink(root_ / "nowhere", root_ / "dangling");
  for (const char* name : {"file", "file/out", "dangling", "dangling/out"}) {
    const std::string message = message_of([&] { OutputFolder output(root_ / name); });
    EXPECT_EQ(message.find(root_.string()), 0U) << message;
  }
  EXPECT_THROW(OutputFolder(""), OutputError);
  EXPECT_THROW(OutputFolder("/proc/sonoglide/out"), OutputError);
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
  EXPECT_EQ(names_in(root_ / "real"), Names{"file"});
  EXPECT_EQ(names_in(root_), (Names{"link", "real"}));
}

TEST_F(OutputFolderTest, DotsAfterALinkMeanWhereItLeads) {
  fs::create_directories(root_ / "deep" / "real");
  fs::create_directory_symlink(root_ / "deep" / "real", root_ / "link");
  OutputFolder output(root_ / "link" / ".." / "out");
  output.commit();
  EXPECT_TRUE(fs::exists(root_ / "deep" / "out"));
}

TEST_F(OutputFolderTest, AStreamThatFailedIsReportedByCommit) {
  {
    OutputFolder output(root_ / "out");
    output.write("summary.json", "{}");
    output.open("trace.csv").setstate(std::ios::badbit);
    const std::string message = message_of([&] { output.commit(); });
    EXPECT_NE(message.find("trace.csv"), std::string::npos) << message;
  }
  EXPECT_EQ(names_in(root_), Names{});
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

TEST_F(OutputFolderTest, AWriteThatTheSystemRefusesIsReported) {
  std::string whole;
  std::string streamed;
  {
    OutputFolder output(root_ / "out");
    output.open("trace.csv") << std::string(20000, 'x');
    {
      const FullDisk limited;
      whole = message_of([&] { output.write("report.html", std::string(100000, 'x')); });
      streamed = message_of([&] { output.commit(); });
    }
  }
  EXPECT_NE(whole.find("report.html: File too large"), std::string::npos) << whole;
  EXPECT_NE(streamed.find("could not be written in full"), std::string::npos) << streamed;
  EXPECT_EQ(names_in(root_), Names{});
}

TEST_F(OutputFolderTest, NamesArePlainAndUsedOnce) {
  OutputFolder output(root_ / "out");
  for (const char* name : {"", ".", "..", "a/b", "/a", "a/"}) {
    EXPECT_THROW(output.write(name, ""), std::invalid_argument) << name;
  }
  output.write("file", "text");
  EXPECT_THROW(output.open("file"), std::invalid_argument);
  EXPECT_THROW(output.withdraw("file"), std::invalid_argument);
}

}  // namespace
}  // namespace sonoglide::report
