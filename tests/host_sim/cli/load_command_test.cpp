// The command that loads a board: a shell hands the file's name on as it is.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "host_sim/cli/board_options.hpp"

namespace sonoglide::cli::load_command_test {
namespace {

const emulated::UnitFile& kind(const char* board, const char* ending) {
  return *emulated::find_unit_board(board)->file(ending);
}

/// What a shell hands to the program, word by word.
std::vector<std::string> words_of(const std::string& command) {
  const std::string program = command.substr(0, command.find(' '));
  const std::string script =
      "sh -c '" + program + "() { for word; do printf \"%s\\n\" \"$word\"; done; }\n" +
      [&] {
        std::string quoted;
        for (const char each : command) {
          quoted += each == '\'' ? std::string("'\\''") : std::string(1, each);
        }
        return quoted;
      }() +
      "'";
  std::FILE* pipe = popen(script.c_str(), "r");
  std::string word;
  std::vector<std::string> words;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) {
    if (c == '\n') {
      words.push_back(word);
      word.clear();
    } else {
      word += static_cast<char>(c);
    }
  }
  EXPECT_EQ(pclose(pipe), 0) << command;
  return words;
}

TEST(LoadCommand, IsPlainForAPlainName) {
  EXPECT_EQ(load_command(kind("nucleo-g474re", ".elf"), "out/unit.elf"),
            "openocd -f board/st_nucleo_g4.cfg -c 'program out/unit.elf verify reset exit'");
  EXPECT_EQ(load_command(kind("pico", ".uf2"), "out/unit.uf2"),
            "cp out/unit.uf2 /media/$USER/RPI-RP2/");
  EXPECT_EQ(load_command(kind("pico2", ".bin"), "unit.bin"), "picotool load -x unit.bin");
}

TEST(LoadCommand, HandsOnAnyName) {
  for (const std::string name : {"a b.bin", "$HOME.bin", "it's.bin", "\"a\".bin", "`a`.bin",
                                 "a;b.bin", "a\\b.bin", "*.bin", "[a].bin", "{a}.bin", "#.bin"}) {
    EXPECT_EQ(words_of(load_command(kind("pico", ".bin"), name)),
              (std::vector<std::string>{"load", "-x", name}));
  }
}

// openocd reads its argument as Tcl: a backslash keeps the character behind it from meaning anything.
TEST(LoadCommand, HandsOnAnyNameInAScript) {
  const auto script = [](const char* name) {
    return words_of(load_command(kind("nucleo-g474re", ".bin"), name)).back();
  };
  const std::string behind = " 0x08000000 verify reset exit";
  EXPECT_EQ(script("a b.bin"), "program a\\ b.bin" + behind);
  EXPECT_EQ(script("$a.bin"), "program \\$a.bin" + behind);
  EXPECT_EQ(script("it's.bin"), "program it's.bin" + behind);
  EXPECT_EQ(script("\"[a]\".bin"), "program \\\"\\[a\\]\\\".bin" + behind);
}

TEST(LoadCommand, NoNameIsTakenForAnOption) {
  EXPECT_EQ(load_command(kind("pico", ".uf2"), "-x.uf2"), "cp ./-x.uf2 /media/$USER/RPI-RP2/");
  EXPECT_EQ(load_command(kind("pico2", ".elf"), "-x.elf"), "picotool load -x ./-x.elf");
  EXPECT_EQ(shown_path("-x/unit.elf"), "./-x/unit.elf");
}

}  // namespace
}  // namespace sonoglide::cli::load_command_test
