/// `sonoglide completion`: what each shell makes of its script.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "command_table.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::completion_test {
namespace {

class Completion : public ::testing::Test {
 protected:
  /// What a shell prints for a command line up to the cursor.
  std::string offered(const std::string& shell, const std::string& line) {
    if (shell == "fish") {
      return run("fish", "-c " + shell_word("source fish; complete -C " + shell_word(line)));
    }
    const std::string script = shell_word(std::string(SONOGLIDE_COMPLETE) + "." + shell);
    const std::string words = script + " ./" + shell + " " + shell_word(line);
    return shell == "bash" ? run("bash", words) : completed_by_zsh(words);
  }

  void SetUp() override {
    for (const std::string shell : {"bash", "zsh", "fish"}) {
      const Outcome outcome = folder_.run("completion " + shell);
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      EXPECT_EQ(outcome.err, "");
      folder_.write(shell, outcome.out);
    }
    folder_.write("a scene.toml", "");
    std::filesystem::create_directory(folder_.path() / "folder");
  }

 private:
  std::string run(const std::string& program, const std::string& arguments) {
    const Outcome outcome = folder_.run_program(program, arguments);
    EXPECT_EQ(outcome.err, "");
    return outcome.out;
  }
  std::string completed_by_zsh(const std::string& words) {
    run("zsh", "-f " + words + " completed");
    return folder_.read("completed");
  }

  ScratchFolder folder_;
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(Completion, OffersEveryCommandWithItsOptions) {
  for (const std::string shell : {"bash", "fish"}) {
    for (const Command& command : command_table) {
      // A command of a group is offered after the word of the group.
      const std::size_t leaf = command.name.rfind(' ') + 1;
      const std::string commands =
          "\n" + offered(shell, "sonoglide " + command.name.substr(0, leaf));
      EXPECT_TRUE(has(commands, "\n" + command.name.substr(leaf))) << shell << commands;
      const std::string options = offered(shell, "sonoglide " + command.name + " x --");
      for (const std::string& option : command.options) {
        EXPECT_TRUE(has(options, option)) << shell << ": " << command.name << "\n" << options;
      }
    }
  }
}

TEST_F(Completion, OffersWordsKeysAndFiles) {
  for (const std::string shell : {"bash", "fish"}) {
    EXPECT_TRUE(has(offered(shell, "sonoglide pil x --board mps2-an5"), "mps2-an505\n") ||
                has(offered(shell, "sonoglide pil x --board mps2-an5"), "mps2-an505\t"));
    EXPECT_TRUE(has(offered(shell, "sonoglide run --set plant.m"), "plant.mass_kg="));
    EXPECT_TRUE(has(offered(shell, "sonoglide sweep x --vary drive.f"), "drive.frequency_Hz="));
    EXPECT_TRUE(has(offered(shell, "sonoglide run fo"), "folder"));
    EXPECT_TRUE(has(offered(shell, "sonoglide run --out fo"), "folder"));
    EXPECT_FALSE(has(offered(shell, "sonoglide run --out a"), "scene"));
    EXPECT_FALSE(has(offered(shell, "sonoglide ratio --dahl-number "), "\n-"));
  }
  // Bash itself keeps what stands before the equals sign.
  EXPECT_EQ(offered("bash", "sonoglide run --set friction.law=da"), "dahl\n");
  EXPECT_TRUE(has(offered("fish", "sonoglide run --set friction.law=da"), "friction.law=dahl"));
}

TEST_F(Completion, CompletesInZsh) {
  for (const auto& [line, completed] : {
           std::pair{"sonoglide ru", "sonoglide run "},
           std::pair{"sonoglide run --js", "sonoglide run --json "},
           std::pair{"sonoglide run --set plant.mas", "sonoglide run --set plant.mass_kg="},
           std::pair{"sonoglide run x --set friction.law=dah",
                     "sonoglide run x --set friction.law=dahl"},
           std::pair{"sonoglide pil x --board micro", "sonoglide pil x --board microbit "},
           std::pair{"sonoglide completion z", "sonoglide completion zsh "},
           std::pair{"sonoglide run fol", "sonoglide run folder/"},
       }) {
    EXPECT_EQ(offered("zsh", line), std::string(completed) + "\n");
  }
}

}  // namespace
}  // namespace sonoglide::acceptance::completion_test
