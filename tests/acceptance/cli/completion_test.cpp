/// `sonoglide complete`, and what each shell makes of its script, which asks it.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "command_table.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::completion_test {
namespace {

/// In a folder with a scene, a file and a folder, and the scripts under the names of their shells.
class Completion : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const std::string shell : {"bash", "zsh", "fish"}) {
      folder_.write(shell, printed("completion " + shell));
    }
    folder_.write("a scene.toml", "");
    folder_.write("notes.txt", "");
    std::filesystem::create_directory(folder_.path() / "notebook");
  }

  std::string printed(const std::string& arguments) const {
    const Outcome outcome = folder_.run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return outcome.out;
  }

  /// The line after a tab.
  std::string completed(const std::string& shell, const std::string& line) const {
    with_program("zsh -f " + shell_word(SONOGLIDE_COMPLETE) + " " + shell + " " + shell_word(line) +
                 " completed");
    return folder_.read("completed");
  }

  std::string offered_by_fish(const std::string& line) const {
    return "\n" +
           with_program("fish -c " + shell_word("source fish; complete -C " + shell_word(line)));
  }

 private:
  /// Shells look for the program by its name.
  std::string with_program(const std::string& command) const {
    const std::filesystem::path program = SONOGLIDE_PROGRAM;
    const Outcome outcome = folder_.run_program(
        "env", "PATH=" + shell_word(program.parent_path().string()) + R"(:"$PATH" )" + command);
    EXPECT_EQ(outcome.err, "");
    return outcome.out;
  }

  ScratchFolder folder_;
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(Completion, OffersEveryCommandWithItsOptions) {
  for (const Command& command : command_table) {
    // A command of a group is offered after the word of the group.
    const std::size_t leaf = command.name.rfind(' ') + 1;
    const std::string commands = printed("complete -- " + command.name.substr(0, leaf) + " ''");
    EXPECT_EQ(commands.find("words\n"), 0U);
    EXPECT_TRUE(has(commands, "\n" + command.name.substr(leaf) + "\t")) << commands;
    EXPECT_FALSE(has(commands, "complete\t"));
    const std::string options = printed("complete -- " + command.name + " x --");
    for (const std::string& option : command.options) {
      EXPECT_TRUE(has(options, "\n" + option + "\t")) << command.name << "\n" << options;
    }
  }
}

TEST_F(Completion, OffersWhatAnOptionOrAnArgumentTakes) {
  EXPECT_TRUE(has(printed("complete -- pil x --board mps2-an5"), "words\nmicrobit\n"));
  EXPECT_TRUE(has(printed("complete -- image x --board ''"), "words\npico\n"));
  EXPECT_EQ(printed("complete -- image x --out ''"), "files\n");
  EXPECT_EQ(printed("complete -- completion z"), "words\nbash\nzsh\nfish\n");
  EXPECT_EQ(printed("complete -- run x --set ''").find("keys\nplant.mass_kg=\tmass"), 0U);
  EXPECT_TRUE(has(printed("complete -- sweep --vary friction."), "\nfriction.law=dahl\t"));
  EXPECT_EQ(printed("complete -- sweep --vary vel").find("keys\nvelocity_ratio=\t"), 0U);
  EXPECT_TRUE(
      has(printed("complete -- sweep --vary friction.law=dahl,"), "\nfriction.law=dahl,coulomb\t"));
  EXPECT_EQ(printed("complete -- identify friction x --law ''").find("words\ncoulomb\ndahl\n"), 0U);
  EXPECT_EQ(printed("complete -- run fo"), "files\n");
  EXPECT_EQ(printed("complete -- identify impedance ''"), "files\n");
  EXPECT_EQ(printed("complete -- run x --out ''"), "folders\n");
  EXPECT_EQ(printed("complete -- ratio --dahl-number ''"), "");
  EXPECT_EQ(printed("complete -- ratio ''"), "");
}

TEST_F(Completion, TakesAnyWords) {
  const std::string commands = printed("complete");
  EXPECT_EQ(printed("complete -- ''"), commands);
  EXPECT_EQ(printed("complete -- --unknown --board scene ''"), commands);
  EXPECT_EQ(printed("complete -- run '[a],b' -- --quiet '' --out ''"), "folders\n");
  EXPECT_EQ(printed("complete -- run --set --out ''"), "files\n") << "--out is the value of --set";
}

struct Typed {
  const char* words;
  const char* completed;
};

TEST_F(Completion, CompletesInBashAndZsh) {
  for (const auto& [words, whole] : {
           Typed{"ru", "run "},
           Typed{"run --js", "run --json "},
           Typed{"run --set plant.mas", "run --set plant.mass_kg="},
           Typed{"pil x --board micro", "pil x --board microbit "},
           Typed{"completion z", "completion zsh "},
           Typed{"identify im", "identify impedance "},
           Typed{"run noteb", "run notebook/"},
           Typed{"run --out no", "run --out notebook/"},
           Typed{"identify friction x --law lug", "identify friction x --law lugre "},
           Typed{"ratio --dahl-number no", "ratio --dahl-number no"},
           Typed{"run a", R"(run a\ scene.toml )"},
           Typed{R"(run a\ scene.toml --set plant.mas)",
                 R"(run a\ scene.toml --set plant.mass_kg=)"},
       }) {
    for (const std::string shell : {"bash", "zsh"}) {
      EXPECT_EQ(completed(shell, std::string("sonoglide ") + words),
                std::string("sonoglide ") + whole + "\n")
          << shell;
    }
  }
  // Bash takes the word for whole.
  EXPECT_EQ(completed("bash", "sonoglide sweep --vary friction.law=dahl,cou"),
            "sonoglide sweep --vary friction.law=dahl,coulomb \n");
  EXPECT_EQ(completed("bash", "sonoglide run --set friction.law=dah"),
            "sonoglide run --set friction.law=dahl \n");
  EXPECT_EQ(completed("zsh", "sonoglide run --set friction.law=dah"),
            "sonoglide run --set friction.law=dahl\n");
  EXPECT_EQ(completed("bash", SONOGLIDE_PROGRAM " ru"), SONOGLIDE_PROGRAM " run \n");
}

TEST_F(Completion, IsOfferedByFish) {
  EXPECT_TRUE(has(offered_by_fish("sonoglide ru"), "\nrun\t"));
  EXPECT_TRUE(has(offered_by_fish("sonoglide run --"), "\n--json\t"));
  EXPECT_TRUE(has(offered_by_fish("sonoglide pil x --board mps2-an5"), "\nmps2-an505\n"));
  EXPECT_TRUE(has(offered_by_fish("sonoglide run --set plant.m"), "\nplant.mass_kg=\tmass"));
  EXPECT_TRUE(
      has(offered_by_fish("sonoglide sweep x --vary friction.law=da"), "\nfriction.law=dahl\t"));
  EXPECT_TRUE(has(offered_by_fish("sonoglide run no"), "\nnotes.txt"));
  EXPECT_TRUE(has(offered_by_fish("sonoglide run --out no"), "\nnotebook/"));
  EXPECT_FALSE(has(offered_by_fish("sonoglide run --out no"), "notes"));
  EXPECT_EQ(offered_by_fish("sonoglide ratio --dahl-number "), "\n");
}

}  // namespace
}  // namespace sonoglide::acceptance::completion_test
