/// The list of keys, and the files that are written from it.
#include "host_sim/scene_file/keys.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/scene_file/key_reference.hpp"

namespace sonoglide::scene_file::keys_test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST(KeysTest, TheFilesAreThoseOfTheList) {
  const fs::path scenes = SONOGLIDE_SCENES;
  EXPECT_TRUE(text_of(scenes / "keys.md") == key_reference())
      << "cmake --build BUILD --target write_keys writes it";
  EXPECT_TRUE(text_of(scenes / "scene.schema.json") == json_schema())
      << "cmake --build BUILD --target write_keys writes it";
}

/// The first line makes room for the one that an installed example has in its place.
TEST(KeysTest, EveryExampleBeginsWithAComment) {
  const std::string line = "# A scene of sonoglide: keys.md explains each key.\n";
  int examples = 0;
  for (const auto& entry : fs::directory_iterator(SONOGLIDE_SCENES)) {
    if (entry.path().extension() == ".toml") {
      EXPECT_EQ(text_of(entry.path()).substr(0, line.size()), line) << entry.path();
      ++examples;
    }
  }
  EXPECT_GE(examples, 20);
}

TEST(KeysTest, AreOneLineEachAndFitATableOfMarkdown) {
  for (const KeyTable& table : key_tables()) {
    for (const Key& key : table.keys) {
      EXPECT_FALSE(key.meaning.empty()) << key.name;
      EXPECT_EQ(key.meaning.find_first_of("\n|"), std::string::npos) << key.name;
      EXPECT_NE(key.meaning.back(), '.') << key.name;
    }
  }
}

/// The keys of a text `one or another`.
std::vector<std::string> names_in(std::string_view words) {
  constexpr std::string_view between = " or ";
  std::vector<std::string> names;
  for (std::size_t end = words.find(between); end != std::string_view::npos;
       end = words.find(between)) {
    names.emplace_back(words.substr(0, end));
    words.remove_prefix(end + between.size());
  }
  names.emplace_back(words);
  return names;
}

/// Whether a key that stands in for others is itself replaced by each of those.
bool is_mutual(const KeyTable& table, const Key& key, const Instead& instead) {
  const std::vector<std::string> others = names_in(instead.others);
  return std::all_of(others.begin(), others.end(), [&](const std::string& other) {
    const auto* back = std::get_if<Instead>(&key_of(table, other).absent);
    const std::vector<std::string> names =
        back != nullptr ? names_in(back->others) : std::vector<std::string>();
    return std::find(names.begin(), names.end(), key.name) != names.end();
  });
}

TEST(KeysTest, OfWhichOneIsRequiredNameEachOther) {
  for (const KeyTable& table : key_tables()) {
    int count = 0;
    for (const Key& key : table.keys) {
      const auto* instead = std::get_if<Instead>(&key.absent);
      count += instead != nullptr ? 1 : 0;
      EXPECT_TRUE(instead == nullptr || is_mutual(table, key, *instead)) << key.name;
    }
    EXPECT_NE(count, 1) << table.name;
  }
}

TEST(KeysTest, AnUnknownNameIsAMistakeOfTheProgram) {
  EXPECT_THROW(key_table("plants"), std::logic_error);
  EXPECT_THROW(key_of(key_table("plant"), "mass"), std::logic_error);
}

}  // namespace
}  // namespace sonoglide::scene_file::keys_test
