/// Whatever a scene's file is called, its name is only ever shown.
#include "tests/acceptance/program/odd_names.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "short_scenes.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance {
namespace {

namespace fs = std::filesystem;

const std::string recorded_open_loop = short_open_loop + R"(record = ["displacement_m"]
record_interval_s = 1e-6
)";

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

TEST_P(OddNameTest, Run) {
  expect_only_shown(run("run " + scene(recorded_open_loop)), 0);
  const std::string folder = results().string();
  EXPECT_TRUE(nlohmann::json::accept(folder_.read(folder + "/summary.json")));
  const std::string page = folder_.read(folder + "/report.html");
  EXPECT_TRUE(is_printable(page.substr(0, page.find("<style>"))));
  EXPECT_EQ(page.find("<script>alert(1)"), std::string::npos);
  EXPECT_NE(folder_.read(folder + "/trace.csv"), "");
}

TEST_P(OddNameTest, RunOfABadScene) {
  const Outcome outcome = run("run " + scene("[plant]\nmass_kg = -1\n"));
  expect_only_shown(outcome, 2);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find(":2:11: plant.mass_kg: -1 is out of range"), std::string::npos);
}

TEST_P(OddNameTest, Sweep) {
  expect_only_shown(run("sweep " + scene(recorded_open_loop) + " --vary velocity_ratio=0.2:1:3"),
                    0);
  EXPECT_NE(folder_.read(results().string() + "/sweep.svg").find("</svg>"), std::string::npos);
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

TEST_P(OddNameTest, Design) {
  const Outcome outcome = run("design " + scene(short_closed_loop) + " --ratio 0.5");
  expect_only_shown(outcome, 0);
  const std::string folder = results().string();
  EXPECT_TRUE(nlohmann::json::accept(folder_.read(folder + "/design.json")));
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
}  // namespace sonoglide::acceptance
