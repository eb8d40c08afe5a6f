/// What a design says and writes.

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>

#include "host_sim/studies/design/report.hpp"
#include "tests/common/csv/csv.hpp"
#include "tests/host_sim/loop/steady/scenes/steady_scenes.hpp"

namespace sonoglide::design::report_test {
namespace {

using steady::falling_lugre;
using steady::resonant;
using steady::stribeck;
using steady::table_1;

DesignStudy study_of(const scene::Scene& scene, const std::vector<double>& ratios,
                     SpeedRange speeds) {
  return study(make_task(configure::make_experiment(scene), ratios, speeds), [](double) {});
}

std::string all_advice(const DesignStudy& study) {
  std::string text;
  for (const Advice& each : advice(study)) {
    text += each.topic + ": " + each.sentence + '\n';
  }
  return text;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(AdviceTest, SaysWhatIsOutOfReachAndWhatIsNearest) {
  const DesignStudy found = study_of(table_1(), {0.2, 0.5}, {0.1, 0.1});
  const std::vector<std::string> short_of = shortfalls(found);
  ASSERT_EQ(short_of.size(), 1U);
  EXPECT_TRUE(contains(short_of[0], "Ratio 0.2 at 100 mm/s is beyond the drive: it needs 281"))
      << short_of[0];
  EXPECT_TRUE(contains(short_of[0], "The nearest at this speed is 0.350")) << short_of[0];
  EXPECT_TRUE(contains(short_of[0], "0.2 is within reach up to 59.4")) << short_of[0];
  EXPECT_TRUE(contains(all_advice(found), "Ratio 0.5: Drive with 151"));
  EXPECT_FALSE(contains(all_advice(found), "Ratio 0.2:"));
}

TEST(AdviceTest, SaysWhichDrivesQuench) {
  const DesignStudy found = study_of(falling_lugre(), {0.5, 0.97}, {0.03, 0.03});
  ASSERT_EQ(found.self_excitation.size(), 1U);
  const std::string advice = all_advice(found);
  EXPECT_TRUE(contains(advice,
                       "Self-excitation: Undriven, steady sliding at 30 mm/s feeds an "
                       "oscillation. It is stable under a drive of 378.8 N to 3 kN, and "
                       "feeds an oscillation under 0 N to 378.8 N."))
      << advice;
  ASSERT_EQ(shortfalls(found).size(), 1U);
  EXPECT_TRUE(contains(shortfalls(found)[0], "Ratio 0.97 at 30 mm/s does not stay: under the 190"))
      << shortfalls(found)[0];
  const nlohmann::ordered_json json = to_json(found)["self_excitation"][0];
  EXPECT_EQ(json["undriven"], "grows");
  EXPECT_EQ(json["windows"].size(), 2U);
  EXPECT_TRUE(study_of(table_1(), {0.5}, {0.02672, 0.02672}).self_excitation.empty());
}

TEST(AdviceTest, SaysWhereTheSceneStandsFromResonance) {
  const SpeedRange speeds{0.02672, 0.02672};
  EXPECT_TRUE(contains(
      all_advice(study_of(table_1(), {0.5}, speeds)),
      "driven above resonance, outside the sensitive band; a stiffer spring saves force: at 0.6"));
  EXPECT_TRUE(contains(all_advice(study_of(retuned(table_1(), 3.0), {0.5}, speeds)),
                       "driven below resonance, outside the sensitive band"));
  EXPECT_TRUE(contains(all_advice(study_of(retuned(table_1(), 0.95), {0.5}, speeds)),
                       "too near to resonance, 1 % of Ks moves ratio 0.5 by 0.1"));
  scene::Scene damped = resonant();
  damped.plant.damping_N_s_per_m = 1500.0;
  EXPECT_TRUE(contains(all_advice(study_of(damped, {0.5}, speeds)),
                       "on the flat top of a damped resonance"));
}

TEST(AdviceTest, SaysWhatStribeckFrictionDenies) {
  const DesignStudy found = study_of(stribeck(), {0.01, 0.5, 1.0}, {0.02672, 0.02672});
  ASSERT_EQ(shortfalls(found).size(), 1U);
  EXPECT_TRUE(contains(shortfalls(found)[0], "more vibration raises the friction again"));
  EXPECT_TRUE(contains(all_advice(found), "Ratio 1: Needs no drive"));
}

TEST(RequirementsCsvTest, HasALineForEachSpeedAndRatio) {
  const DesignStudy found = study_of(table_1(), {0.2, 0.5}, {0.01, 0.1});
  const csv::Table table(requirements_csv(found));
  std::map<std::pair<double, double>, int> points;
  std::map<std::string, int> limits;
  for (const csv::Row& row : table.rows()) {
    ++points[{row.number("sliding_velocity_m_per_s"), row.number("friction_ratio")}];
    ++limits[row.text("limit")];
  }
  EXPECT_EQ(table.rows().size(), 2U * 41);
  EXPECT_EQ(points.size(), 2U * 41) << "each speed with each ratio once";
  EXPECT_GE(limits["none"], 1);
  EXPECT_GE(limits["actuator"], 1);
}

TEST(ToJsonTest, HoldsPointsReachAndDetuning) {
  const DesignStudy found = study_of(table_1(), {0.5}, {0.01, 0.1});
  const auto json = to_json(found);
  ASSERT_EQ(json["points"].size(), 2U);
  const auto& point = json["points"][1];
  EXPECT_EQ(point["sliding_velocity_m_per_s"], 0.1);
  EXPECT_EQ(point["drive_force_N"], found.points[1].requirement.motion.drive_force_N);
  EXPECT_EQ(point["sensitivities"][0]["key"], "plant.mass_kg");
  EXPECT_FALSE(point.contains("reason"));
  EXPECT_EQ(json["reach"][0]["fastest_sliding_m_per_s"], found.curves[0].fastest_m_per_s);
  EXPECT_EQ(json["detuning"][0]["reachable_tuning"]["high"], found.detunings[0].reachable->high);
  EXPECT_EQ(json["scene"]["plant"]["mass_kg"], 0.02);
}

TEST(ToJsonTest, HasNullForWhatIsNotDefined) {
  const DesignStudy found = study_of(stribeck(), {0.01, 0.5}, {0.02672, 0.02672});
  const auto json = to_json(found);
  EXPECT_TRUE(json["points"][0]["drive_force_N"].is_null());
  EXPECT_EQ(json["points"][0]["limit"], "amplitude");
  EXPECT_TRUE(contains(requirements_csv(found), ",nan,"));
}

}  // namespace
}  // namespace sonoglide::design::report_test
