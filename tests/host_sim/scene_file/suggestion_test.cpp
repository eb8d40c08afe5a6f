#include "host_sim/scene_file/suggestion.hpp"

#include <gtest/gtest.h>

#include <string>

namespace sonoglide::scene_file::suggestion_test {
namespace {

TEST(EditDistanceTest, KnownDistances) {
  EXPECT_EQ(edit_distance("", ""), 0U);
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("saturday", "sunday"), 3U);
  EXPECT_EQ(edit_distance("dahl", "dhal"), 1U) << "a swap is one edit";
  EXPECT_EQ(edit_distance("ca", "abc"), 3U) << "no part is edited twice";
  EXPECT_EQ(edit_distance("Mass_KG", "mass_kg"), 0U);
}

TEST(NearestNameTest, FindsTypingErrors) {
  const std::vector<std::string_view> known = {"frequency_Hz", "force_amplitude_N", "waveform"};
  EXPECT_EQ(nearest_name("freqency_Hz", known), "frequency_Hz");
  EXPECT_EQ(nearest_name("force_amplitude_kN", known), "force_amplitude_N");
  EXPECT_EQ(nearest_name("force_amplitude", known), "force_amplitude_N");
  EXPECT_EQ(nearest_name("wave_form", known), "waveform");
}

TEST(NearestNameTest, TakesTheFirstOfEquals) {
  EXPECT_EQ(nearest_name("mast", {"mass", "most"}), "mass");
}

TEST(NearestNameTest, HasNothingForFarNames) {
  const std::vector<std::string_view> known = {"law", "coefficient"};
  EXPECT_FALSE(nearest_name("temperature", known).has_value());
  EXPECT_FALSE(nearest_name("ab", known).has_value()) << "shorter than what may be wrong in it";
  EXPECT_FALSE(nearest_name("", known).has_value());
  EXPECT_FALSE(nearest_name("law", {}).has_value());
  EXPECT_FALSE(nearest_name(std::string(1000000, 'l'), known).has_value());
}

}  // namespace
}  // namespace sonoglide::scene_file::suggestion_test
