/// A parsed document with numbers for its varied keys is the same scene, or the same error, as the
/// text with a `--set` option for each of them.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "host_sim/scene_file/echo.hpp"
#include "host_sim/scene_file/keys.hpp"
#include "host_sim/scene_file/reader.hpp"
#include "host_sim/scene_file/variant.hpp"
#include "scene_texts.hpp"

namespace sonoglide::scene_file::variant_test {
namespace {

using Texts = std::vector<std::string>;
using Numbers = std::vector<double>;

/// The shortest text that reads back the same.
std::string option(const std::string& key, double number) {
  return is_written_whole(number) ? fmt::format("{}={:.0f}", key, number)
                                  : fmt::format("{}={}", key, number);
}

std::vector<VariedValue> values(const Numbers& numbers) {
  return {numbers.begin(), numbers.end()};
}

/// What an error of a --set is, were its option a --vary behind some overrides.
std::string as_varied(const SceneError& error, std::size_t overrides) {
  const std::string form_of_set = "TABLE.KEY=VALUE, or TABLE.KEY= to remove the key";
  std::string message = error.message();
  if (const std::size_t at = message.find(form_of_set); at != std::string::npos) {
    message.replace(at, form_of_set.size(),
                    "KEY=FROM:TO:COUNT, KEY=FROM:TO:COUNT:log or KEY=A,B,...");
  }
  return SceneError({"--vary", error.line() - overrides, error.column()},
                    error.key() == "--set" ? "--vary" : error.key(), message)
      .what();
}

/// The scene in full or the whole error, as if all options but the first few were --vary.
template <class Read>
std::string outcome(std::size_t overrides, const Read& read) {
  try {
    return to_json(read()).dump();
  } catch (const SceneError& error) {
    const bool varied = error.file() == "--set" && error.line() > overrides;
    return varied ? as_varied(error, overrides) : error.what();
  }
}

/// With a few overrides first, which the varied keys follow.
void expect_as_by_text(const std::string& text, const Texts& overrides, const Texts& keys,
                       const Numbers& numbers) {
  Texts all = overrides;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    all.push_back(option(keys[i], numbers[i]));
  }
  const std::string by_text =
      outcome(overrides.size(), [&] { return read_text(text, "a/s.toml", all); });
  const std::string by_number = outcome(overrides.size(), [&] {
    const Document document({"a/s.toml", text}, overrides, keys);
    return read(document, values(numbers));
  });
  ASSERT_EQ(by_number, by_text) << fmt::format("{} {}", keys.front(), numbers.front());
}

Texts every_key() {
  Texts keys;
  for (const KeyTable& table : key_tables()) {
    for (const Key& key : table.keys) {
      keys.push_back(fmt::format("{}.{}", table.name, key.name));
    }
  }
  return keys;
}

const Texts texts = {shortest_open_loop, fullest_open_loop, shortest_closed_loop,
                     fullest_closed_loop};

TEST(VariantTest, EveryKeyTakesEveryKindOfNumberAsTextDoes) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Numbers numbers = {-0.0, 1.0,  -1.0,   0.5,     16.0,  1e-7,     5e-324,
                           6e4,  1e15, 1.5e15, 9.99e15, -3e20, infinity, nan};
  for (const std::string& text : texts) {
    for (const std::string& key : every_key()) {
      for (const double number : numbers) {
        expect_as_by_text(text, {}, {key}, {number});
        if (HasFatalFailure()) {
          return;
        }
      }
    }
  }
}

TEST(VariantTest, RandomKeysAndNumbersAreAsByText) {
  const Texts keys = every_key();
  EXPECT_TRUE(rc::check([&keys] {
    const auto text = *rc::gen::elementOf(texts);
    const auto number = [] {
      const double digits = static_cast<double>(*rc::gen::inRange(-1000000, 1000000));
      return digits * std::pow(10.0, *rc::gen::inRange(-18, 12));
    };
    const Texts overrides = {option(*rc::gen::elementOf(keys), number())};
    const Texts varied = {*rc::gen::elementOf(keys), *rc::gen::elementOf(keys)};
    expect_as_by_text(text, overrides, varied, {number(), number()});
    RC_ASSERT_FALSE(testing::Test::HasFatalFailure());
  }));
}

TEST(VariantTest, BadNamesAreAsByText) {
  for (const char* key : {"plant", "mass_kg", "plant.mass", "plants.mass_kg", "plant.mass_kg.x",
                          "sliding.profile[0]", "", "a\nb.c", "."}) {
    for (const std::string& text : texts) {
      expect_as_by_text(text, {"friction.coefficient=0.2"}, {"plant.mass_kg", key}, {0.02, 1.0});
      expect_as_by_text(text, {"friction.weight=0.2"}, {key}, {1.0});
    }
  }
}

TEST(VariantTest, AnUnusedKeyIsAnErrorAtItsOption) {
  const Document document({"s", shortest_open_loop}, {"plant.mass_kg=1"}, {"solver.step_s"});
  try {
    read(document, values({1e-8}));
    FAIL() << "no error";
  } catch (const SceneError& error) {
    EXPECT_STREQ(
        error.what(),
        "--vary:1:1: solver.step_s: not used with solver.method = \"event_taylor\"; remove "
        "it");
  }
}

TEST(VariantTest, WordsAreAsByText) {
  for (const std::string word : {"dahl", "coulomb", "dhal", "", "1e4"}) {
    for (const std::string& text : texts) {
      for (const char* key : {"friction.law", "solver.method", "plant.mass_kg"}) {
        const std::string by_text =
            outcome(0, [&] { return read_text(text, "s", {fmt::format("{}=\"{}\"", key, word)}); });
        const std::string by_word = outcome(0, [&] {
          const Document document({"s", text}, {}, {key});
          return read(document, {VariedValue(word)});
        });
        EXPECT_EQ(by_word, by_text) << key << ' ' << word;
      }
    }
  }
}

TEST(VariantTest, UnusedKeysGoToWhoTakesThem) {
  const Document document({"s", shortest_open_loop}, {"solver.step_s=1e-8", "friction.elements=2"});
  UnusedKeys unused;
  read(document, {}, &unused);
  EXPECT_EQ(unused, (UnusedKeys{"friction.elements", "solver.step_s"}));
}

TEST(VariantTest, OneDocumentServesManyReadings) {
  const Document document({"dir/step.toml", fullest_closed_loop}, {},
                          {"model_error.mass", "sensor.seed"});
  for (int i = 1; i <= 100; ++i) {
    const scene::Scene scene = read(document, values({0.9 + 1e-3 * i, static_cast<double>(i)}));
    EXPECT_EQ(scene.name, "step");
    EXPECT_EQ(scene.model_error.mass, 0.9 + 1e-3 * i);
    EXPECT_EQ(scene.sensor.seed, static_cast<std::uint64_t>(i));
  }
}

TEST(VariantTest, AnErrorLeavesTheDocumentAsItWas) {
  const Document document({"s", shortest_open_loop}, {}, {"friction.coefficient"});
  EXPECT_THROW(read(document, values({-1.0})), SceneError);
  EXPECT_EQ(read(document, values({0.25})).friction.coefficient, 0.25);
}

}  // namespace
}  // namespace sonoglide::scene_file::variant_test
