/// Scenes that cannot be read at all. Root may read every file whatever its mode, so that an
/// unreadable one is a path through a file and a link to nothing.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base_scenes.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::scene_files_test {
namespace {

using Entries = std::vector<std::string>;

void expect_rejected(const ScratchFolder& folder, const std::string& scene,
                     const std::string& error) {
  const Entries before = folder.entries();
  const Outcome outcome = folder.run("run " + scene);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, error + "\n");
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(folder.entries(), before);
}

TEST(SceneFileTest, Missing) {
  const ScratchFolder folder;
  expect_rejected(folder, "none.toml",
                  "none.toml:1:1: scene: No such file or directory; allowed: a readable TOML file");
}

TEST(SceneFileTest, Directory) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.path() / "scene.toml");
  expect_rejected(folder, "scene.toml",
                  "scene.toml:1:1: scene: is a directory; allowed: a readable TOML file");
}

TEST(SceneFileTest, PathThroughAFile) {
  const ScratchFolder folder;
  folder.write("good.toml", open_loop);
  expect_rejected(
      folder, "good.toml/scene.toml",
      "good.toml/scene.toml:1:1: scene: Not a directory; allowed: a readable TOML file");
}

TEST(SceneFileTest, LinkToNothing) {
  const ScratchFolder folder;
  std::filesystem::create_symlink("nowhere.toml", folder.path() / "link.toml");
  expect_rejected(folder, "link.toml",
                  "link.toml:1:1: scene: No such file or directory; allowed: a readable TOML file");
}

TEST(SceneFileTest, LinkToItself) {
  const ScratchFolder folder;
  std::filesystem::create_symlink("loop.toml", folder.path() / "loop.toml");
  expect_rejected(folder, "loop.toml",
                  "loop.toml:1:1: scene: Too many levels of symbolic links; allowed: a readable "
                  "TOML file");
}

TEST(SceneFileTest, Empty) {
  const ScratchFolder folder;
  folder.write("empty.toml", "");
  expect_rejected(folder, "empty.toml",
                  "empty.toml:1:1: plant: missing; required: a table [plant]");
}

TEST(SceneFileTest, BinaryNoise) {
  const ScratchFolder folder;
  folder.write("noise.toml", std::string("\x7f"
                                         "ELF\x02\x01\x01\0\0\0",
                                         10));
  expect_rejected(folder, "noise.toml",
                  "noise.toml:1:1: toml: root table: expected keys, tables, "
                  "whitespace or comments, saw '\\u007F'; allowed: TOML 1.0, in UTF-8");
}

TEST(SceneFileTest, TooLarge) {
  const ScratchFolder folder;
  folder.write("large.toml", std::string(1048577, '\n'));
  expect_rejected(
      folder, "large.toml",
      "large.toml:1:1: scene: larger than 1048576 bytes; allowed: at most 1048576 bytes");
}

TEST(SceneFileTest, LargestThatIsRead) {
  const ScratchFolder folder;
  const std::string scene = open_loop;
  folder.write("large.toml", scene + std::string(1048576 - scene.size(), '\n'));
  EXPECT_EQ(folder.run("run large.toml --quiet").exit_code, 0);
}

TEST(SceneFileTest, EndlessFile) {
  const ScratchFolder folder;
  expect_rejected(
      folder, "/dev/zero",
      "/dev/zero:1:1: scene: larger than 1048576 bytes; allowed: at most 1048576 bytes");
}

TEST(SceneFileTest, DeeplyNestedArray) {
  const ScratchFolder folder;
  folder.write("deep.toml", "plant = " + std::string(100000, '['));
  expect_rejected(folder, "deep.toml",
                  "deep.toml:1:265: toml: value: exceeded maximum nested value "
                  "depth of 256; allowed: TOML 1.0, in UTF-8");
}

TEST(SceneFileTest, DeeplyDottedKey) {
  const ScratchFolder folder;
  std::string key = "plant";
  for (int i = 0; i < 250000; ++i) {
    key += ".a";
  }
  folder.write("deep.toml", key + " = 1\n");
  expect_rejected(folder, "deep.toml",
                  "deep.toml:1:38: toml: a name with more than 16 dots; allowed: at most 16");
}

}  // namespace
}  // namespace sonoglide::acceptance::scene_files_test
