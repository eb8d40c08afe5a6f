/// The JSON Schema says what the reader says, as far as a key does not depend on another.
#include "host_sim/scene_file/key_reference.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <toml++/toml.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "every_scene.hpp"
#include "host_sim/scene_file/echo.hpp"
#include "host_sim/scene_file/keys.hpp"
#include "host_sim/scene_file/reader.hpp"
#include "host_sim/scene_file/toml_text.hpp"

namespace sonoglide::scene_file::json_schema_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

ordered_json as_json(const std::string& toml_text) {
  std::ostringstream json;
  json << toml::json_formatter{parse_toml(toml_text, "s")};
  return ordered_json::parse(json.str());
}

/// A scene, and the same as a schema sees it.
struct Scene {
  std::string text;
  ordered_json json;
};

/// Together they have every key.
std::vector<Scene> whole_scenes() {
  std::vector<Scene> scenes;
  for (const std::string& text : every_scene()) {
    const ordered_json echo = to_json(read_text(text, "s"));
    scenes.push_back({text, as_json(text)});
    scenes.push_back({to_toml(echo), echo});
  }
  return scenes;
}

bool has_key(const Scene& scene, std::string_view table, std::string_view key) {
  return scene.json.contains(std::string(table)) &&
         scene.json[std::string(table)].contains(std::string(key));
}

/// Values in TOML that the key does not allow.
struct WrongValues {
  std::vector<std::string> operator()(const Number& number) const {
    std::vector<std::string> values = wrong_numbers(number.range);
    values.emplace_back("true");
    values.emplace_back("'1'");
    return values;
  }
  std::vector<std::string> operator()(const Integer& integer) const {
    std::vector<std::string> values = {"1.5", "'1'", std::to_string(integer.low - 1)};
    if (integer.high < std::numeric_limits<std::int64_t>::max()) {
      // Past 2^53 the next integer but one is the next that JavaScript has.
      constexpr std::int64_t every_one_to = std::int64_t{1} << 53U;
      values.push_back(std::to_string(integer.high + (integer.high < every_one_to ? 1 : 2)));
    }
    return values;
  }
  std::vector<std::string> operator()(const Word& /*word*/) const { return {"'no word'", "1"}; }
  std::vector<std::string> operator()(const WordList& list) const {
    return {"1", "['no word']", fmt::format("['{0}', '{0}']", list.allowed.front())};
  }
  std::vector<std::string> operator()(const Profile& profile) const {
    std::vector<std::string> values = {"1", "[]", "[1]", "[[0]]", "[[0, 'one']]", "[[-1, 0.5]]"};
    for (const std::string& value : wrong_numbers(profile.value)) {
      values.push_back(fmt::format("[[0, {}]]", value));
    }
    return values;
  }
  std::vector<std::string> operator()(const Interval& interval) const {
    std::vector<std::string> values = {"1", "[]", "[1]", "[1, 2, 3]", "['1', 2]"};
    for (const std::string& value : wrong_numbers(interval.range)) {
      values.push_back(fmt::format("[{}, 1]", value));
    }
    return values;
  }
  std::vector<std::string> operator()(const Truth& /*truth*/) const { return {"1", "'true'"}; }
  std::vector<std::string> operator()(const TextureTable& texture) const {
    std::vector<std::string> values = {"1",
                                       "{}",
                                       "[0.5, 0.6]",
                                       "{ ratio = [0.5, 0.6] }",
                                       "{ period_m = 1e-3 }",
                                       "{ period_m = 1e-3, ratio = 0.5 }",
                                       "{ period_m = 1e-3, ratio = [0.5] }",
                                       "{ period_m = 1e-3, ratio = [0.5, '0.6'] }",
                                       "{ period_m = '1', ratio = [0.5, 0.6] }",
                                       "{ period_m = 1e-3, ratio = [0.5, 0.6], force_N = [1, 2] }",
                                       "{ period_m = 1e-3, ratio = [0.5, 0.6], phase = 1 }"};
    for (const std::string& number : wrong_numbers(texture.period)) {
      values.push_back(fmt::format("{{ period_m = {}, ratio = [0.5, 0.6] }}", number));
    }
    for (const std::string& number : wrong_numbers(texture.ratio)) {
      values.push_back(fmt::format("{{ period_m = 1e-3, ratio = [0.5, {}] }}", number));
    }
    for (const std::string& number : wrong_numbers(texture.force)) {
      values.push_back(fmt::format("{{ period_m = 1e-3, force_N = [0.5, {}] }}", number));
    }
    return values;
  }
  std::vector<std::string> operator()(const Spread& spread) const {
    std::vector<std::string> values = {"true",
                                       "'0.1'",
                                       "[0, 1]",
                                       "{}",
                                       "{ width = 0.1 }",
                                       "{ normal = -0.1 }",
                                       "{ normal = 'a' }",
                                       "{ range = 1 }",
                                       "{ range = [1] }",
                                       "{ normal = 0.1, range = [1, 2] }"};
    values.insert(values.end(), {"0", "-0.1", "101"});
    if (spread.whole) {
      values.insert(values.end(), {"1", "{ normal = 0.1 }", "{ range = [1.5, 2.5] }"});
    }
    for (const std::string& number : wrong_numbers(spread.range)) {
      values.push_back(fmt::format("{{ range = [{}, 1] }}", number));
    }
    return values;
  }

 private:
  static std::vector<std::string> wrong_numbers(const Range& range) {
    const double beyond_low = range.low - 0.01 * std::max(std::abs(range.low), 1e-3);
    return {fmt::format("{:.17g}", range.low_open ? range.low : beyond_low),
            fmt::format("{:.17g}", 1.01 * range.high)};
  }
};

/// What a file `scene` becomes when the option `--set` is applied.
ordered_json changed(ordered_json scene, std::string_view table, std::string_view key,
                     const std::string& value) {
  scene[std::string(table)][std::string(key)] = as_json("value = " + value)["value"];
  return scene;
}

bool reader_accepts(const std::string& text, const std::vector<std::string>& overrides) {
  try {
    read_text(text, "s", overrides);
    return true;
  } catch (const SceneError&) {
    return false;
  }
}

/// Where tools/setup puts what editors judge a scene with, ajv and taplo; empty: nowhere.
const fs::path node_modules = SONOGLIDE_NODE_MODULES;

enum class Judge { python, editors };

/// @param command  takes a file of cases
void expect_agreement(const std::string& command, const fs::path& file) {
  FILE* output = popen(fmt::format("{} '{}' 2>&1", command, file.string()).c_str(), "r");
  ASSERT_NE(output, nullptr);
  std::string text;
  std::array<char, 4096> part{};
  while (std::fgets(part.data(), part.size(), output) != nullptr) {
    text += part.data();
  }
  EXPECT_EQ(pclose(output), 0) << text;
}

class Cases {
 public:
  void add(const std::string& name, const ordered_json& scene, bool accepted) {
    list_.push_back(
        {{"name", name}, {"accepted", accepted}, {"scene", scene}, {"toml", to_toml(scene)}});
  }

  /// A value that the reader refuses for the key itself.
  void add_wrong(const Scene& scene, const KeyTable& table, std::string_view key,
                 const std::string& value) {
    const std::string option = fmt::format("{}.{}={}", table.name, key, value);
    std::string refused;
    try {
      read_text(scene.text, "s", {option});
    } catch (const SceneError& error) {
      refused = error.key();
    }
    EXPECT_EQ(refused.find(fmt::format("{}.{}", table.name, key)), 0U) << option << ": " << refused;
    add(option, changed(scene.json, table.name, key, value), false);
  }

  /// Has the schema judge all of them.
  void check(Judge judge) const {
    ASSERT_FALSE(list_.empty());
    const fs::path file =
        fs::path(testing::TempDir()) / fmt::format("scene_cases_{}.json", getpid());
    std::ofstream(file) << ordered_json{{"schema", ordered_json::parse(json_schema())},
                                        {"cases", list_}};
    expect_agreement(judge == Judge::editors
                         ? fmt::format("NODE_PATH='{}' node '{}'", node_modules.string(),
                                       SONOGLIDE_EDITORS_CHECK)
                         : fmt::format("'{}' '{}'", SONOGLIDE_INTERPRETER, SONOGLIDE_SCHEMA_CHECK),
                     file);
    fs::remove(file);
  }

 private:
  ordered_json list_ = ordered_json::array();
};

/// By a library of Python's; by what editors use, where it is there.
class JsonSchemaJudged : public testing::TestWithParam<Judge> {
 protected:
  void SetUp() override {
    if (GetParam() == Judge::editors && !fs::exists(node_modules)) {
      GTEST_SKIP() << "without npm, and under sanitizers";
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Judges, JsonSchemaJudged, testing::Values(Judge::python, Judge::editors),
                         [](const auto& judge) {
                           return judge.param == Judge::editors ? "editors" : "python";
                         });

TEST(JsonSchemaTest, HasEveryKeyAndNoOther) {
  const ordered_json schema = ordered_json::parse(json_schema());
  std::set<std::string> described;
  for (const auto& [table, content] : schema["properties"].items()) {
    EXPECT_EQ(content["additionalProperties"], false) << table;
    for (const auto& [key, value] : content["properties"].items()) {
      described.insert(fmt::format("{}.{}", table, key));
    }
  }
  std::set<std::string> read;
  for (const KeyTable& table : key_tables()) {
    for (const Key& key : table.keys) {
      read.insert(fmt::format("{}.{}", table.name, key.name));
    }
  }
  EXPECT_EQ(described, read);
}

TEST_P(JsonSchemaJudged, AcceptsWhatTheReaderAccepts) {
  Cases cases;
  for (const char* folder : {SONOGLIDE_SCENES, SONOGLIDE_SCENE_CORPUS}) {
    int accepted = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() != ".toml") {
        continue;
      }
      std::ifstream file(entry.path(), std::ios::binary);
      const std::string text{std::istreambuf_iterator<char>(file),
                             std::istreambuf_iterator<char>()};
      if (reader_accepts(text, {})) {
        cases.add(entry.path().filename(), as_json(text), true);
        ++accepted;
      }
    }
    EXPECT_GE(accepted, 5) << folder;
  }
  for (const Scene& scene : whole_scenes()) {
    cases.add(scene.text, scene.json, true);
  }
  cases.check(GetParam());
}

TEST_P(JsonSchemaJudged, RefusesTheValuesThatTheReaderRefuses) {
  Cases cases;
  const std::vector<Scene> scenes = whole_scenes();
  for (const KeyTable& table : key_tables()) {
    for (const Key& key : table.keys) {
      const auto scene = std::find_if(scenes.begin(), scenes.end(), [&](const Scene& each) {
        return has_key(each, table.name, key.name);
      });
      ASSERT_NE(scene, scenes.end()) << table.name << "." << key.name;
      for (const std::string& value : std::visit(WrongValues{}, key.allowed)) {
        cases.add_wrong(*scene, table, key.name, value);
      }
    }
  }
  cases.check(GetParam());
}

TEST_P(JsonSchemaJudged, RefusesUnknownKeysAndTables) {
  Cases cases;
  const std::vector<Scene> scenes = whole_scenes();
  for (const KeyTable& table : key_tables()) {
    cases.add_wrong(scenes.back(), table, "no_such_key", "1");
  }
  EXPECT_FALSE(reader_accepts(scenes.back().text, {"no_such_table.key=1"}));
  cases.add("table", changed(scenes.back().json, "no_such_table", "key", "1"), false);
  cases.check(GetParam());
}

/// Without one of these keys there is no scene.
TEST_P(JsonSchemaJudged, RefusesScenesWithoutARequiredKey) {
  Cases cases;
  int removed = 0;
  const Scene scene = whole_scenes().back();
  for (const KeyTable& table : key_tables()) {
    for (const Key& key : table.keys) {
      const bool needed = std::holds_alternative<Required>(key.absent) && key.used_text().empty();
      if (!(needed || std::holds_alternative<Instead>(key.absent)) ||
          !has_key(scene, table.name, key.name)) {
        continue;
      }
      const std::string option = fmt::format("{}.{}=", table.name, key.name);
      EXPECT_FALSE(reader_accepts(scene.text, {option})) << option;
      ordered_json without = scene.json;
      without[std::string(table.name)].erase(std::string(key.name));
      cases.add(option, without, false);
      ++removed;
    }
  }
  EXPECT_GE(removed, 5);
  cases.check(GetParam());
}

}  // namespace
}  // namespace sonoglide::scene_file::json_schema_test
