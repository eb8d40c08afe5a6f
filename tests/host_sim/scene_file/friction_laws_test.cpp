/// What every law in the list is held to, by its own description.

#include "host_sim/scene/friction_laws.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/scene/cores/solver_choice.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "host_sim/scene/solver_facts.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "host_sim/scene_file/echo.hpp"
#include "host_sim/scene_file/keys.hpp"

namespace sonoglide::scene::friction_laws_test {
namespace {

/// The least that a scene may give for each of a law's own keys.
struct LeastValues {
  struct Key {
    std::string name;
    double value;
    bool required;
  };
  std::vector<Key> keys;

  void required(std::string_view key, double& parameter, const scene_file::Range& range,
                std::string_view /*meaning*/) {
    add(key, parameter, range, true);
  }
  void optional(std::string_view key, double& parameter, const scene_file::Range& range,
                std::string_view /*meaning*/) {
    add(key, parameter, range, false);
  }
  void optional(std::string_view key, int& count, int least, int /*most*/,
                std::string_view /*meaning*/) {
    count = least;
    keys.push_back({std::string(key), static_cast<double>(least), false});
  }
  void refuse(std::string_view /*key*/, double& parameter, std::string_view /*finding*/,
              double least, std::string_view /*rest*/) {
    parameter = least;
    keys.back().value = least;
  }

 private:
  void add(std::string_view key, double& parameter, const scene_file::Range& range, bool required) {
    parameter = range.low;
    keys.push_back({std::string(key), range.low, required});
  }
};

std::vector<LeastValues::Key> own_keys(FrictionLaw law) {
  ContactValues contact;
  contact.coefficient = 0.1;
  LeastValues values;
  std::visit([&](auto& any) { any.visit_keys(values, contact); }, law);
  return values.keys;
}

/// A scene with this law, its own keys but one, and more lines of [friction].
std::string scene_text(const FrictionLaw& law, std::string_view without = "",
                       std::string_view more = "") {
  std::string text = fmt::format("[friction]\nlaw = \"{}\"\n", name_of(law));
  if (!is<scene::laws::None>(law)) {
    text += "coefficient = 0.1\n";
  }
  if (is_elastic(law)) {
    text += "contact_stiffness_N_per_m = 0.056e6\n";
  }
  for (const LeastValues::Key& key : own_keys(law)) {
    text += key.name == without ? "" : fmt::format("{} = {:.17g}\n", key.name, key.value);
  }
  return fmt::format(
      "{}{}\n[plant]\nmass_kg = 0.02\nstiffness_N_per_m = 133e6\n"
      "[sliding]\nvelocity_m_per_s = 0.02\n[run]\nduration_s = 1e-3\n",
      text, more);
}

std::string error_of(const std::string& text) {
  try {
    experiment::read_text(text, "scene.toml");
  } catch (const scene_file::SceneError& error) {
    return error.what();
  }
  return "";
}

class FrictionLawTest : public testing::TestWithParam<FrictionLaw> {};

TEST_P(FrictionLawTest, IsFoundByItsName) {
  EXPECT_EQ(law_index(name_of(GetParam())), GetParam().index());
}

TEST_P(FrictionLawTest, IsReadAndEchoedWithItsOwnKeys) {
  const Scene scene = experiment::read_text(scene_text(GetParam()), "scene.toml").plant;
  EXPECT_EQ(scene.friction.law.index(), GetParam().index());
  const auto echo = scene_file::to_json(scene)["friction"];
  EXPECT_EQ(echo["law"], name_of(GetParam()));
  for (const LeastValues::Key& key : own_keys(GetParam())) {
    EXPECT_EQ(echo[key.name], key.value) << key.name;
  }
}

TEST_P(FrictionLawTest, AsksForTheKeysThatItRequires) {
  for (const LeastValues::Key& key : own_keys(GetParam())) {
    const std::string error = error_of(scene_text(GetParam(), key.name));
    EXPECT_EQ(error.find(key.name + ": missing; required: ") != std::string::npos, key.required)
        << key.name << ": " << error;
  }
}

TEST_P(FrictionLawTest, RefusesTheKeysOfOthers) {
  const std::vector<LeastValues::Key> own = own_keys(GetParam());
  for (const FrictionLaw& other : every_law) {
    for (const LeastValues::Key& key : own_keys(other)) {
      const bool shared = std::any_of(own.begin(), own.end(),
                                      [&](const auto& mine) { return mine.name == key.name; });
      const std::string error =
          shared ? "" : error_of(scene_text(GetParam(), "", key.name + " = 1.0"));
      EXPECT_EQ(error.find(fmt::format("not used with friction.law = \"{}\"",
                                       name_of(GetParam()))) != std::string::npos,
                !shared)
          << key.name << ": " << error;
    }
  }
}

TEST_P(FrictionLawTest, IsTakenByTheDefaultSolver) {
  EXPECT_TRUE(scene::solves(SolverMethod{}, GetParam()));
}

INSTANTIATE_TEST_SUITE_P(List, FrictionLawTest, testing::ValuesIn(every_law),
                         [](const auto& law) { return std::string(name_of(law.param)); });

}  // namespace
}  // namespace sonoglide::scene::friction_laws_test
