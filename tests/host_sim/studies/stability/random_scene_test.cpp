/// The scenes span what they say they span, and number n is always the same.

#include "host_sim/studies/stability/random_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "host_sim/configure/plant_scales.hpp"

namespace sonoglide::stability::random_scene_test {
namespace {

constexpr std::uint64_t drawn = 5000;

std::vector<scene::Scene> scenes() {
  std::vector<scene::Scene> all;
  for (std::uint64_t n = 0; n < drawn; ++n) {
    all.push_back(random_scene(n));
  }
  return all;
}

void expect_share(const std::vector<scene::Scene>& all, double low, double high,
                  const std::function<bool(const scene::Scene&)>& is_one) {
  const auto count = std::count_if(all.begin(), all.end(), is_one);
  const double share = static_cast<double>(count) / static_cast<double>(all.size());
  EXPECT_GE(share, low);
  EXPECT_LE(share, high);
}

TEST(RandomScene, DependsOnItsNumberAlone) {
  const scene::Scene first = random_scene(42);
  random_scene(7);
  const scene::Scene again = random_scene(42);
  EXPECT_EQ(first.plant.mass_kg, again.plant.mass_kg);
  EXPECT_EQ(first.plant.stiffness_N_per_m, again.plant.stiffness_N_per_m);
  EXPECT_EQ(first.friction.normal_force_N, again.friction.normal_force_N);
  EXPECT_EQ(first.sliding.profile.back().velocity_m_per_s,
            again.sliding.profile.back().velocity_m_per_s);
  EXPECT_NE(first.plant.mass_kg, random_scene(43).plant.mass_kg);
}

TEST(RandomScene, HasTheSameBitsOnEveryMachine) {
  EXPECT_EQ(random_scene(0).plant.mass_kg, 0x1.3c33f270bbd3cp-13);
  EXPECT_EQ(random_scene(1).plant.mass_kg, 0x1.edacc08e576c7p-16);
  EXPECT_EQ(random_scene(99999).plant.mass_kg, 0x1.a42f9036d43d3p-1);
}

TEST(RandomScene, StaysInsideItsRanges) {
  for (const scene::Scene& scene : scenes()) {
    const scene::Plant& plant = scene.plant;
    EXPECT_TRUE(plant.mass_kg >= 0.999e-9 && plant.mass_kg <= 1.001e3) << scene.name;
    EXPECT_TRUE(plant.damping_N_s_per_m >= 0.0 && plant.damping_N_s_per_m <= 1e12) << scene.name;
    EXPECT_LE(std::abs(scene.friction.initial_force_N), scene.friction.limit_N());
    EXPECT_LE(scene.friction.coefficient, 10.001);
    EXPECT_LE(scene.friction.normal_force_N, 1.001e6);
    const double begin = scene.sliding.profile.front().velocity_m_per_s;
    const double end = scene.sliding.profile.back().velocity_m_per_s;
    EXPECT_LE(std::abs(begin), 1.001e3);
    EXPECT_GE(begin * end, 0.0) << "a stretch of sliding keeps its sign";
    EXPECT_GT(scene.run.duration_s, 0.0);
  }
}

TEST(RandomScene, MeetsEverySpecialCaseOften) {
  const std::vector<scene::Scene> all = scenes();
  expect_share(all, 0.05, 0.15, [](auto& s) { return s.plant.stiffness_N_per_m == 0.0; });
  expect_share(all, 0.3, 0.5, [](auto& s) { return s.plant.damping_N_s_per_m == 0.0; });
  expect_share(all, 0.05, 0.2, [](auto& s) { return !s.drive; });
  expect_share(all, 0.05, 0.2,
               [](auto& s) { return s.drive && s.drive->force_amplitude_N == 0.0; });
  expect_share(all, 0.05, 0.2,
               [](auto& s) { return scene::is<scene::laws::None>(s.friction.law); });
  expect_share(all, 0.2, 0.4,
               [](auto& s) { return scene::is<scene::laws::Coulomb>(s.friction.law); });
  expect_share(all, 0.05, 0.15, [](auto& s) {
    return !scene::is<scene::laws::None>(s.friction.law) && s.friction.limit_N() == 0.0;
  });
  expect_share(all, 0.15, 0.3, [](auto& s) {
    return s.friction.sign_convention == scene::SignConvention::as_printed;
  });
  expect_share(all, 0.05, 0.15,
               [](auto& s) { return s.sliding.profile.front().velocity_m_per_s == 0.0; });
  expect_share(all, 0.4, 0.5,
               [](auto& s) { return s.sliding.profile.front().velocity_m_per_s < 0.0; });
  expect_share(all, 0.02, 0.15, [](auto& s) {
    const configure::PlantNumbers numbers = configure::plant_numbers(s, configure::plant_scales(s));
    return std::abs(numbers.stiffness - 1.0) < 1e-12;
  });
}

}  // namespace
}  // namespace sonoglide::stability::random_scene_test
