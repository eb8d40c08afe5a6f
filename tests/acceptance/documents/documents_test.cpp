/// The commands of the documents print what they show.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "documents.hpp"
#include "host_sim/process/regular_expression.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::documents_test {
namespace {

namespace fs = std::filesystem;

const fs::path source = SONOGLIDE_SOURCE;

/// What stands between fences: its language, and its lines.
struct Block {
  std::string language;
  std::vector<std::string> lines;
};

std::vector<Block> blocks_of(const fs::path& document) {
  std::vector<Block> blocks;
  bool inside = false;
  for (const std::string& line : lines_of(document)) {
    if (line.rfind("```", 0) == 0) {
      inside = !inside;
      if (inside) {
        blocks.push_back({line.substr(3), {}});
      }
    } else if (inside) {
      blocks.back().lines.push_back(line);
    }
  }
  return blocks;
}

/// A folder that looks like the root of a built repository.
class BuiltRepository {
 public:
  BuiltRepository() {
    const fs::path root = folder_.path();
    fs::create_directories(root / "build/release/bin");
    fs::create_symlink(SONOGLIDE_PROGRAM, root / "build/release/bin/sonoglide");
    fs::create_directories(root / "host_sim");
    fs::create_directory_symlink(source / "host_sim/scenes", root / "host_sim/scenes");
    fs::create_directories(root / "tools");
    for (const char* built : {"tools/demo", "build/release/bin/cmake"}) {
      folder_.write(built, "#!/bin/sh\n");
      fs::permissions(root / built, fs::perms::owner_all);
    }
  }

  /// Both streams of a shell that runs these commands there.
  Outcome run(const std::string& commands) const {
    folder_.write("commands", commands);
    const std::string root = folder_.path().string();
    const std::string line = "cd " + shell_word(root) + " && PATH=" + shell_word(root) +
                             "/build/release/bin:\"$PATH\" sh -e commands >shown 2>&1";
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, folder_.read("shown"), ""};
  }

 private:
  ScratchFolder folder_;
};

/// Run times differ from machine to machine.
bool is_timing(const std::string& line) {
  return line.find("times real time") != std::string::npos;
}

void expect_shown(const std::vector<std::string>& expected, const std::string& shown,
                  const std::string& commands) {
  int compared = 0;
  for (const std::string& line : expected) {
    if (!is_timing(line)) {
      ++compared;
      EXPECT_NE(shown.find(line), std::string::npos)
          << "not printed: " << line << "\nby: " << commands << "\nwhich prints:\n"
          << shown;
    }
  }
  EXPECT_GE(compared, 1) << commands;
}

TEST(Documents, TheFirstOneIsShort) {
  EXPECT_LE(lines_of(source / "README.md").size(), 150U);
}

TEST(Documents, EveryCommandHasAnExampleInItsManual) {
  const ScratchFolder folder;
  const std::string help = folder.run("--help").out;
  const std::string commands = help.substr(help.find("Subcommands:"));
  const std::string examples = joined(lines_of(source / "tools/debian/examples.cmake"));
  const process::RegularExpression command(R"(\n  ([a-z][a-z-]*))");
  int found = 0;
  for (const process::Match& each : command.search_all(commands)) {
    ++found;
    const std::string& name = each[1];
    EXPECT_NE(examples.find("set(examples_sonoglide-" + name), std::string::npos) << name;
  }
  EXPECT_GT(found, 10);
}

/// How many blocks are compared.
int expect_commands_shown(const fs::path& document) {
  const BuiltRepository repository;
  const std::vector<Block> blocks = blocks_of(document);
  int compared = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (blocks[i].language != "sh") {
      continue;
    }
    const std::string commands = joined(blocks[i].lines);
    const Outcome outcome = repository.run(commands);
    const bool shows = i + 1 < blocks.size() && blocks[i + 1].language.empty();
    if (shows) {
      expect_shown(blocks[i + 1].lines, outcome.out, commands);
      ++compared;
    } else {
      EXPECT_EQ(outcome.exit_code, 0) << commands << outcome.out;
    }
  }
  return compared;
}

TEST(Documents, TheTutorialShowsWhatItsCommandsPrint) {
  EXPECT_GT(expect_commands_shown(source / "host_sim/scenes/README.md"), 8);
}

TEST(Documents, TheExplanationShowsWhatItsCommandsPrint) {
  EXPECT_EQ(expect_commands_shown(source / "host_sim/scenes/why_vibration_lowers_friction.md"), 3);
}

TEST(Documents, TheUsesShowWhatTheirCommandsPrint) {
  EXPECT_EQ(expect_commands_shown(source / "host_sim/scenes/what_the_friction_is_for.md"), 13);
}

/// Commands of at most some seconds, in this folder; the others have tests of their own.
bool is_quick(const std::string& commands) {
  static const process::RegularExpression quick(R"(^sonoglide (run|ratio|design|configure) )");
  return !quick.search(commands).empty() && commands.find("cmake") == std::string::npos &&
         commands.find("$HOME") == std::string::npos;
}

TEST(Documents, TheQuickCommandsOfTheReferenceRun) {
  const BuiltRepository repository;
  int ran = 0;
  for (const fs::path& document : documents_in(source)) {
    for (const Block& block : blocks_of(document)) {
      const std::string commands = joined(block.lines);
      if (block.language == "sh" && document.parent_path().filename() != "scenes" &&
          is_quick(commands)) {
        const Outcome outcome = repository.run(commands);
        EXPECT_EQ(outcome.exit_code, 0) << document << '\n' << commands << outcome.out;
        ++ran;
      }
    }
  }
  EXPECT_GT(ran, 3);
}

/// A program that reads our files, and a line in its language that says what it read.
struct Reader {
  std::string language;
  std::string program;  ///< takes its commands as the last word
  std::string is_there;
  std::string question;
  std::string answer;
};

const Reader readers[] = {
    {"python", shell_word(SONOGLIDE_INTERPRETER) + " -c",
     shell_word(SONOGLIDE_INTERPRETER) + " -c 'import pandas'",
     "print(len(periods), periods['friction_ratio'].dtype)", "360 float64"},
    // Octave has the same function.
    {"matlab", "octave-cli --eval", "command -v octave-cli",
     "printf('%d %s', size(trace.data, 2), trace.colheaders{3})", "4 friction_force_N"},
    {"sql",
     "NODE_PATH=" + shell_word(SONOGLIDE_NODE_MODULES) + " node " + shell_word(SONOGLIDE_DUCKDB),
     "test -d " + shell_word(SONOGLIDE_NODE_MODULES) + "/@duckdb",
     "; SELECT count(*), typeof(any_value(friction_ratio)) FROM 'periods.parquet'", "360 DOUBLE"},
};

class ReadersOfCsv : public testing::TestWithParam<Reader> {};
INSTANTIATE_TEST_SUITE_P(Documents, ReadersOfCsv, testing::ValuesIn(readers),
                         [](const auto& reader) { return reader.param.language; });

TEST_P(ReadersOfCsv, ReadWithTheLineOfTheReference) {
  const Reader& reader = GetParam();
  const BuiltRepository repository;
  if (repository.run(reader.is_there).exit_code != 0) {
    GTEST_SKIP() << "not there: " << reader.is_there;
  }
  std::string commands;
  for (const Block& block : blocks_of(source / "host_sim/README.md")) {
    commands += block.language == reader.language ? joined(block.lines) : "";
  }
  const Outcome outcome =
      repository.run("sonoglide run --quiet host_sim/scenes/target_step.toml\n" + reader.program +
                     " " + shell_word(commands + reader.question) + "\n");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
  EXPECT_NE(outcome.out.find(reader.answer), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace sonoglide::acceptance::documents_test
