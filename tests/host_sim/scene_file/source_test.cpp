#include "host_sim/scene_file/source.hpp"

#include <gtest/gtest.h>

#include <iostream>
#include <sstream>
#include <string>

#include "host_sim/scene_file/echo.hpp"
#include "host_sim/scene_file/reader.hpp"
#include "scene_texts.hpp"

namespace sonoglide::scene_file::source_test {
namespace {

std::string name_of_file(const std::string& file) {
  return Source{file, ""}.name();
}

TEST(SourceTest, ASceneIsNamedAfterItsFilePrintably) {
  EXPECT_EQ(name_of_file("a/target_step.toml"), "target_step");
  EXPECT_EQ(name_of_file("a/x'; system(\"y\") #.toml"), "x'; system(\"y\") #");
  EXPECT_EQ(name_of_file("a\nb.toml"), "a\\x0ab");
  EXPECT_EQ(name_of_file("\x1b[31m.toml"), "\\x1b[31m");
  EXPECT_EQ(name_of_file("caf\xe9.toml"), "caf\\xe9");
  EXPECT_EQ(name_of_file("...toml"), "..");
}

TEST(SourceTest, ASceneThatAStudyWroteIsNamedAfterItsFolderToo) {
  EXPECT_EQ(name_of_file("out/langevin_impedance/scene.toml"), "langevin_impedance_scene");
  EXPECT_EQ(name_of_file("/out/robust_step_robust/worst.toml"), "robust_step_robust_worst");
  EXPECT_EQ(name_of_file("worst.toml"), "worst");
  EXPECT_EQ(name_of_file("./scene.toml"), "scene");
  EXPECT_EQ(name_of_file("../scene.toml"), "scene");
  EXPECT_EQ(name_of_file("/scene.toml"), "scene");
  EXPECT_EQ(name_of_file("a/my_scene.toml"), "my_scene");
}

/// Standard input holds a text while it lives.
class StandardInput {
 public:
  explicit StandardInput(const std::string& text)
      : text_(text), before_(std::cin.rdbuf(text_.rdbuf())) {
    std::cin.clear();
  }
  ~StandardInput() { std::cin.rdbuf(before_); }

 private:
  std::istringstream text_;
  std::streambuf* before_;
};

TEST(SourceTest, ADashIsStandardInput) {
  const StandardInput input(shortest_open_loop);
  const scene::Scene scene = read_file("-", {"plant.mass_kg=0.5"});
  EXPECT_EQ(scene.name, "stdin");
  EXPECT_EQ(scene.plant.mass_kg, 0.5);
}

TEST(SourceTest, ErrorsInStandardInputSaySo) {
  const StandardInput input("[plant]\nmass_kg = -1\n");
  try {
    read_file("-");
    FAIL() << "no error";
  } catch (const SceneError& error) {
    EXPECT_EQ(std::string(error.what()).find("<stdin>:2:11: plant.mass_kg: "), 0U) << error.what();
  }
}

scene::Scene read_with(const std::vector<std::string>& overrides) {
  return read_text(shortest_open_loop, "s", overrides);
}

TEST(RemovalTest, AKeyGivesWayToAnother) {
  const scene::Scene scene =
      read_with({"sliding.velocity_m_per_s=", "sliding.profile=[[0,0.01],[1e-3,0.05]]"});
  ASSERT_EQ(scene.sliding.profile.size(), 2U);
  EXPECT_EQ(scene.sliding.profile[1].velocity_m_per_s, 0.05);
}

TEST(RemovalTest, ALaterOptionWins) {
  EXPECT_EQ(read_with({"plant.mass_kg=", "plant.mass_kg=3"}).plant.mass_kg, 3.0);
  EXPECT_THROW(read_with({"plant.mass_kg=3", "plant.mass_kg="}), SceneError);
}

TEST(RemovalTest, WhatIsNotThereIsGoneAlready) {
  EXPECT_EQ(to_json(read_with({"sensor.adc_bits=", "plant.damping_N_s_per_m="})),
            to_json(read_with({})));
}

TEST(RemovalTest, OnlyKeysOfScenesAreRemoved) {
  for (const char* option : {"plant.weight=", "plant=", "weight.plant=", "="}) {
    EXPECT_THROW(read_with({option}), SceneError) << option;
  }
}

}  // namespace
}  // namespace sonoglide::scene_file::source_test
