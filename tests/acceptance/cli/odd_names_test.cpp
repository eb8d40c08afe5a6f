/// Whatever a scene's file is called, its name is only ever shown.
#include "tests/acceptance/program/odd_names.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command_table.hpp"
#include "scene_folder.hpp"
#include "short_scenes.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::odd_names_test {
namespace {

namespace fs = std::filesystem;

class OddNameTest : public testing::TestWithParam<std::string> {
 protected:
  OddNameTest() { fs::create_directory(inner_); }

  /// The scene as a shell word.
  std::string scene(const std::string& text) const {
    folder_.write("inner/" + GetParam() + ".toml", text);
    return shell_word("./" + GetParam() + ".toml");
  }
  Outcome run(const std::string& arguments) const {
    // In a folder inside: what goes to a parent is seen.
    return folder_.run(arguments, "inner");
  }
  void expect_only_shown(const Outcome& outcome, int exit_code) const {
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_TRUE(is_printable(outcome.out)) << outcome.out;
    EXPECT_TRUE(is_printable(outcome.err)) << outcome.err;
    for (const fs::directory_entry& entry : fs::directory_iterator(inner_)) {
      const std::string name = entry.path().filename().string();
      EXPECT_TRUE(name == "out" || name == GetParam() + ".toml") << name;
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 1);
  }
  /// A file that a command wrote is what its ending says, whatever the name in it.
  void expect_only_shown_in(const fs::path& file) const {
    const std::string text = folder_.read(file.string());
    const std::string ending = file.extension().string();
    EXPECT_NE(text, "") << file;
    if (ending == ".json") {
      EXPECT_TRUE(nlohmann::json::accept(text)) << file;
    } else if (ending == ".html") {
      EXPECT_TRUE(is_printable(text.substr(0, text.find("<style>")))) << file;
      EXPECT_EQ(text.find("<script>alert(1)"), std::string::npos) << file;
    } else if (ending == ".svg") {
      EXPECT_NE(text.find("</svg>"), std::string::npos) << file;
    } else {
      EXPECT_TRUE(is_printable(text)) << file;
    }
  }
  /// The one folder in `out`.
  fs::path results() const {
    const std::vector<fs::directory_entry> entries{fs::directory_iterator(inner_ / "out"),
                                                   fs::directory_iterator()};
    EXPECT_EQ(entries.size(), 1U);
    return fs::path("inner/out") / entries.front().path().filename();
  }

  ScratchFolder folder_;
  fs::path inner_ = folder_.path() / "inner";
};

TEST_P(OddNameTest, IsOnlyShownByEveryCommand) {
  int checked = 0;
  for (const Command& command : command_table) {
    if (!command.scene.empty() && command.effort == Effort::instant) {
      SCOPED_TRACE(command.name);
      fs::remove_all(inner_ / "out");
      const std::string name = scene(text_of_scene(command.scene));
      expect_only_shown(run(words_with_scene(command, name)), 0);
      for (const std::string& file : command.files) {
        expect_only_shown_in(results() / file);
        ++checked;
      }
    }
  }
  EXPECT_GE(checked, 12) << "files of run, configure, sweep and design";
}

TEST_P(OddNameTest, RunOfABadScene) {
  const Outcome outcome = run("run " + scene("[plant]\nmass_kg = -1\n"));
  expect_only_shown(outcome, 2);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find(":2:11: plant.mass_kg: -1 is out of range"), std::string::npos);
}

TEST_P(OddNameTest, Configure) {
  folder_.write("plain.toml", short_closed_loop);
  EXPECT_EQ(folder_.run("configure plain.toml --out . --quiet").exit_code, 0);
  const std::string plain = folder_.read("controller_configuration.hpp");
  for (const char* name : {"plain.toml", "controller_configuration.hpp", ".sonoglide"}) {
    fs::remove(folder_.path() / name);
  }
  expect_only_shown(run("configure " + scene(short_closed_loop)), 0);
  const std::string header = folder_.read(results().string() + "/controller_configuration.hpp");
  EXPECT_TRUE(is_printable(header));
  EXPECT_EQ(header.rfind("/// The controller of the scene ", 0), 0U);
  EXPECT_EQ(header.substr(header.find('\n')), plain.substr(plain.find('\n')));
}

INSTANTIATE_TEST_SUITE_P(Names, OddNameTest, testing::ValuesIn(odd_names),
                         [](const auto& name) { return "name_" + std::to_string(name.index); });

TEST(LongNameTest, HasAFolderOfItsOwn) {
  const ScratchFolder folder;
  const std::string begin(249, 'a');
  for (const char* end : {"b", "c"}) {
    folder.write(begin + end + ".toml", recorded_open_loop);
    EXPECT_EQ(folder.run("run " + begin + end + ".toml --quiet").exit_code, 0);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path() / "out"), fs::directory_iterator()),
            2);
}

}  // namespace
}  // namespace sonoglide::acceptance::odd_names_test
