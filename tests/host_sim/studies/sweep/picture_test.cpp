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
                                   const std::vector<PointResult>& series) {
  const ScratchScene scratch(open_loop);
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
