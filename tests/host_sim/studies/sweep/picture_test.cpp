#include "host_sim/studies/sweep/report.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/host_sim/studies/sweep/scenes/base_scenes.hpp"
#include "tests/host_sim/studies/sweep/scenes/scratch_scene.hpp"

namespace sonoglide::sweep::picture_test {
namespace {

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

std::vector<PointResult> rows(std::size_t count) {
  std::vector<PointResult> all(count);
  for (std::size_t i = 0; i < count; ++i) {
    all[i].friction_ratio_window = static_cast<double>(i);
    all[i].friction_ratio_whole_run = 1.0;
  }
  return all;
}

std::optional<std::string> printed(const std::vector<std::string>& vary,
                                   const std::vector<PointResult>& series,
                                   const std::string& scene = open_loop) {
  const ScratchScene scratch(scene);
  const auto sheet = picture(Plan(scene_file::read_source(scratch.file()), {}, vary), series);
  return sheet ? std::optional(output::print(*sheet)) : std::nullopt;
}

TEST(PictureTest, AHeatMapHasACellForEachPointAndGreysTheFailed) {
  std::vector<PointResult> series = rows(12);
  series[5].friction_ratio_window = PointResult::undefined;
  const auto svg = printed(
      {"velocity_ratio=1:0.1:4", "friction.contact_stiffness_N_per_m=1e4:1e6:3:log"}, series);
  ASSERT_TRUE(svg.has_value());
  EXPECT_EQ(occurrences(*svg, "fill = 'rgb(184, 184, 184)'"), 1U);
  EXPECT_NE(svg->find("velocity_ratio"), std::string::npos);
  EXPECT_NE(svg->find("friction.contact_stiffness_N_per_m"), std::string::npos);
  EXPECT_NE(svg->find("Friction ratio, window [-]"), std::string::npos);
}

TEST(PictureTest, ABigHeatMapIsThinnedOut) {
  const auto svg =
      printed({"velocity_ratio=0.1:1:2", "friction.coefficient=0.1:0.2:1000"}, rows(2000));
  ASSERT_TRUE(svg.has_value());
  EXPECT_LT(svg->size(), 200000U);
}

TEST(PictureTest, OneKeyIsACurve) {
  std::vector<PointResult> series = rows(5);
  series[2] = PointResult();
  series[2].status = "failed";
  const auto svg = printed({"velocity_ratio=0.1:1:5", "friction.coefficient=0.1:0.1:1"}, series);
  ASSERT_TRUE(svg.has_value());
  EXPECT_NE(svg->find("whole run"), std::string::npos);
  EXPECT_NE(svg->find(">failed<"), std::string::npos);
}

std::string with(std::string scene, const std::string& part, const std::string& other) {
  const std::size_t at = scene.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return scene.replace(at, part.size(), other);
}

// Beside a displacement or a texture there is no second figure of the same unit.
TEST(PictureTest, OfALoadItIsItsDisplacementAlone) {
  std::vector<PointResult> series = rows(3);
  for (PointResult& row : series) {
    row.load_final_displacement_m = 2.0 * row.friction_ratio_window;
  }
  const std::string loaded = with(open_loop, "[sliding]\nvelocity_m_per_s = 0.0267",
                                  "[load]\nmass_kg = 0.01\ninitial_velocity_m_per_s = 0.05");
  const auto svg = printed({"drive.force_amplitude_N=100:300:3"}, series, loaded);
  ASSERT_TRUE(svg.has_value());
  EXPECT_NE(svg->find("Displacement of the load at the end [m]"), std::string::npos);
  EXPECT_NE(svg->find(">Displacement of the load<"), std::string::npos);
  for (const char* other : {">window<", ">whole run<", "ripple"}) {
    EXPECT_EQ(svg->find(other), std::string::npos) << other;
  }
}

TEST(PictureTest, OfATextureItIsItsAmplitudeAlone) {
  std::vector<PointResult> series = rows(3);
  for (PointResult& row : series) {
    row.texture_amplitude_ratio = 1.0;
  }
  const std::string texture = with(closed_loop, "target_friction_ratio = [[0.0, 0.4]]",
                                   "target_texture = { period_m = 1e-4, ratio = [0.4, 0.6] }");
  const auto svg = printed({"drive.max_force_amplitude_N=1000:2000:3"}, series, texture);
  ASSERT_TRUE(svg.has_value());
  EXPECT_NE(svg->find(">Amplitude of the texture<"), std::string::npos);
  for (const char* other : {">window<", ">whole run<", "steady error", "ripple"}) {
    EXPECT_EQ(svg->find(other), std::string::npos) << other;
  }
}

TEST(PictureTest, OfATargetItIsTheSteadyErrorWithItsRipple) {
  std::vector<PointResult> series = rows(3);
  for (PointResult& row : series) {
    row.steady_error = 0.1;
    row.ripple = 0.01;
  }
  const auto svg = printed({"drive.max_force_amplitude_N=1000:2000:3"}, series, closed_loop);
  ASSERT_TRUE(svg.has_value());
  EXPECT_NE(svg->find("steady error ± ripple"), std::string::npos);
}

TEST(PictureTest, WordsStandSideBySide) {
  const auto svg = printed({"friction.law=coulomb,dahl,transverse_coulomb"}, rows(3));
  ASSERT_TRUE(svg.has_value());
  for (const char* word : {">coulomb<", ">dahl<", ">transverse_coulomb<", "friction.law"}) {
    EXPECT_NE(svg->find(word), std::string::npos) << word;
  }
}

TEST(PictureTest, WordsAgainstNumbersAreACurveForEachWord) {
  std::vector<PointResult> series = rows(8);
  series[1].friction_ratio_window = PointResult::undefined;
  for (const bool words_first : {true, false}) {
    const std::vector<std::string> vary = {"friction.law=coulomb,dahl", "velocity_ratio=0.1:1:4"};
    const auto svg =
        printed(words_first ? vary : std::vector<std::string>{vary[1], vary[0]}, series);
    ASSERT_TRUE(svg.has_value());
    EXPECT_NE(svg->find(">coulomb<"), std::string::npos);
    EXPECT_NE(svg->find(">dahl<"), std::string::npos);
  }
}

/// A page wants abscissae that rise.
TEST(PictureTest, ValuesThatFallAreDrawnFromTheirEnd) {
  const ScratchScene scratch(open_loop);
  using Lists = std::vector<std::vector<std::string>>;
  for (const auto& vary : Lists{{"velocity_ratio=1:0.1:3"},
                                {"velocity_ratio=1,0.5,0.1"},
                                {"velocity_ratio=1:0.1:3:log", "friction.law=coulomb,dahl"}}) {
    const auto sheet = picture(Plan(scene_file::read_source(scratch.file()), {}, vary),
                               rows(vary.size() == 1 ? 3 : 6));
    ASSERT_TRUE(sheet.has_value());
    const output::Chart& chart = sheet->charts.front();
    EXPECT_EQ(chart.x.front(), 0.1);
    EXPECT_EQ(chart.x.back(), 1.0);
    const std::vector<double>& y = chart.curves.back().y;
    EXPECT_GT(y.front(), y.back());
  }
}

TEST(PictureTest, WordsAgainstWordsAreAMap) {
  const auto svg =
      printed({"friction.law=dahl,coulomb", "friction.coefficient=0.1,0.3,0.2"}, rows(6));
  ASSERT_TRUE(svg.has_value());
  for (const char* word : {">coulomb<", ">0.3<"}) {
    EXPECT_NE(svg->find(word), std::string::npos) << word;
  }
}

TEST(PictureTest, NoPictureOfMoreKeysNorOfNothing) {
  EXPECT_FALSE(printed({"velocity_ratio=0.1:1:2", "friction.coefficient=0.1:0.2:2",
                        "plant.mass_kg=0.01:0.02:2"},
                       rows(8))
                   .has_value());
  EXPECT_FALSE(printed({"velocity_ratio=0.1:0.1:1"}, rows(1)).has_value());
  EXPECT_FALSE(printed({"velocity_ratio=0.1:1:2"}, std::vector<PointResult>(2)).has_value());
}

}  // namespace
}  // namespace sonoglide::sweep::picture_test
