/// Scenes and options as nobody would write them: every command answers in its own words.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "scene_folder.hpp"
#include "tests/acceptance/program/odd_names.hpp"

namespace sonoglide::acceptance::hostile_input_test {
namespace {

using Random = std::mt19937;

const std::vector<std::string> odd_values = {
    "0",        "-1",       "1e-300",  "1e308",     "5e-324",     "1e-12", "9223372036854775807",
    "nan",      "-inf",     "1e9",     "2",         "0.5",        "true",  "[]",
    "[[0, 1]]", "\"dahl\"", "\"q31\"", "{ a = 1 }", "1979-05-27", "0,5",   "",
    "1e",       "\"\"",     "[1, 2"};

/// What a library says of itself, and no message of the program does.
const std::array<const char*, 14> words_of_libraries = {"error of the program itself",
                                                        "std::",
                                                        "basic_string",
                                                        "stoi",
                                                        "stod",
                                                        "vector::",
                                                        "bad_alloc",
                                                        "[json",
                                                        "filesystem",
                                                        "terminate",
                                                        "Error in function",
                                                        "boost",
                                                        "regex",
                                                        "temp_directory_path"};

template <class Choices>
auto one_of(const Choices& choices, Random& random) {
  return choices[random() % choices.size()];
}

/// Another value in place of one, or a line twice or not at all.
std::string mutated(const std::string& text, Random& random) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  const int changes = 1 + static_cast<int>(random() % 3);
  for (int i = 0; i < changes; ++i) {
    const std::size_t at = random() % lines.size();
    const std::size_t equals = lines[at].find('=');
    if (equals != std::string::npos && random() % 4 != 0) {
      lines[at] = lines[at].substr(0, equals + 1) + one_of(odd_values, random);
    } else if (random() % 2 == 0) {
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at), lines[at]);
    } else {
      lines[at].clear();
    }
  }
  std::string result;
  for (const std::string& line : lines) {
    result += line + '\n';
  }
  return result;
}

/// One of the command's options with a value that it may or may not take.
std::string odd_option(const Command& command, Random& random) {
  if (command.options.empty() || random() % 2 == 0) {
    return "";
  }
  const std::vector<std::string> values = {"",
                                           "-1",
                                           "0",
                                           "1e400",
                                           "x",
                                           "a=b",
                                           "1/0",
                                           "2/1",
                                           "0,5",
                                           "1:2",
                                           "a:b:c",
                                           "3",
                                           "1e-9:1",
                                           "plant.mass_kg=1:0:3:log",
                                           "plant.mass_kg=0,02",
                                           "drive.x=1",
                                           "friction.law=\"none\"",
                                           "open.toml",
                                           "."};
  const std::string option = one_of(command.options, random);
  return option == "--quiet" || option == "--json"
             ? " " + option
             : " " + option + " " + shell_word(one_of(values, random));
}

class HostileInputTest : public testing::TestWithParam<Command> {};

TEST_P(HostileInputTest, IsAnsweredInTheProgramsOwnWords) {
  constexpr int cases = 10;
  const Command& command = GetParam();
  Random random(static_cast<unsigned>(command.name.size() + 7));
  for (int i = 0; i < cases; ++i) {
    const SceneFolder folder;
    if (!command.scene.empty()) {
      folder.write("odd.toml", mutated(text_of_scene(command.scene), random));
    }
    const std::string words = words_with_scene(command, command.scene.empty() ? "" : "odd.toml") +
                              odd_option(command, random);
    // What such a scene asks for may take for ever.
    const Outcome outcome = folder.run_program("timeout", "1 '" SONOGLIDE_PROGRAM "' " + words);
    constexpr int timed_out = 124;
    EXPECT_TRUE(outcome.exit_code == timed_out ||
                (outcome.exit_code >= 0 && outcome.exit_code <= 3))
        << outcome.exit_code << ": " << words << "\n"
        << folder.read("odd.toml");
    EXPECT_EQ(outcome.exit_code == 0 || outcome.exit_code == timed_out || !outcome.err.empty(),
              true);
    EXPECT_TRUE(is_printable(outcome.err)) << outcome.err;
    for (const char* word : words_of_libraries) {
      EXPECT_EQ(outcome.err.find(word), std::string::npos)
          << words << "\n"
          << outcome.err << folder.read("odd.toml");
    }
  }
}

std::vector<Command> commands_here() {
  std::vector<Command> found;
  std::copy_if(command_table.begin(), command_table.end(), std::back_inserter(found),
               [](const Command& each) {
                 return each.effort != Effort::emulator && each.name.rfind("identify", 0) != 0;
               });
  return found;
}

INSTANTIATE_TEST_SUITE_P(Commands, HostileInputTest, testing::ValuesIn(commands_here()),
                         [](const auto& tested) {
                           std::string name = tested.param.name;
                           std::replace_if(
                               name.begin(), name.end(),
                               [](char c) { return c == '-' || c == ' '; }, '_');
                           return name;
                         });

}  // namespace
}  // namespace sonoglide::acceptance::hostile_input_test
