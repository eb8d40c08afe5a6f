/// [tolerance] and [true_values]: what they give, and how they fail.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/scene_file/reader.hpp"
#include "tests/common/scenes.hpp"

namespace sonoglide::scene_file::tolerances_test {
namespace {

const std::string scene_text = table_1_closed_loop + R"([run]
duration_s = 1e-3
[controller]
arithmetic = "float32"
target_friction_ratio = [[0.0, 0.4]]
[sensor]
force_offset_N = -0.01
adc_bits = 12
)";

scene::Scene with(const std::string& tables, const std::vector<std::string>& overrides = {}) {
  return read_text(scene_text + tables, "s.toml", overrides);
}

/// What stderr says after the file's name, the table beginning in line 21.
std::string error_of(const std::string& tables, const std::vector<std::string>& overrides = {}) {
  try {
    experiment::read_text(scene_text + tables, "s.toml", overrides);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "none";
}

std::string tolerance_error(const std::string& line) {
  return error_of("[tolerance]\n" + line + "\n");
}

TEST(ToleranceTest, IsAHalfWidthADeviationOrARange) {
  const scene::Scene scene = with(R"([tolerance]
"plant.stiffness_N_per_m" = 0.04
"sensor.force_offset_N" = 1
"friction.coefficient" = { normal = 0.1 }
"friction.contact_stiffness_N_per_m" = { range = [0.03e6, 1e5] }
"sensor.adc_bits" = { range = [10, 12] }
)");
  ASSERT_EQ(scene.tolerances.size(), 5U);
  const scene::Tolerance& stiffness = scene.tolerances[0];
  EXPECT_EQ(stiffness.key, "plant.stiffness_N_per_m");
  EXPECT_EQ(stiffness.spread, scene::Spread::half_width);
  EXPECT_EQ(stiffness.nominal, 133e6);
  EXPECT_DOUBLE_EQ(stiffness.lowest, 127.68e6);
  EXPECT_DOUBLE_EQ(stiffness.highest, 138.32e6);
  EXPECT_EQ(scene.tolerances[1].lowest, -0.02) << "relative to the magnitude";
  EXPECT_EQ(scene.tolerances[1].highest, 0.0);
  EXPECT_EQ(scene.tolerances[2].spread, scene::Spread::normal);
  EXPECT_EQ(scene.tolerances[2].amount, 0.1);
  EXPECT_EQ(scene.tolerances[2].highest, 100.0) << "the range of the key";
  EXPECT_EQ(scene.tolerances[3].lowest, 0.03e6);
  EXPECT_EQ(scene.tolerances[3].highest, 1e5);
  EXPECT_TRUE(scene.tolerances[4].whole);
}

TEST(ToleranceTest, TakesOverridesAndMayBeRemoved) {
  const std::vector<std::string> set = {"tolerance.plant.stiffness_N_per_m=0.02",
                                        "tolerance.friction.coefficient={ normal = 0.2 }"};
  const scene::Scene scene = with("[tolerance]\n\"plant.stiffness_N_per_m\" = 0.04\n", set);
  ASSERT_EQ(scene.tolerances.size(), 2U);
  EXPECT_EQ(scene.tolerances[0].amount, 0.02);
  EXPECT_TRUE(with("[tolerance]\n\"plant.mass_kg\" = 0.04\n", {"tolerance.plant.mass_kg="})
                  .tolerances.empty());
  const scene::Scene quoted =
      with("[tolerance]\n\"plant.mass_kg\" = 0.04\n",
           {"tolerance.\"plant.mass_kg\"=", "tolerance . 'plant.stiffness_N_per_m' =0.03"});
  ASSERT_EQ(quoted.tolerances.size(), 1U);
  EXPECT_EQ(quoted.tolerances[0].key, "plant.stiffness_N_per_m");
  EXPECT_EQ(quoted.tolerances[0].amount, 0.03);
}

TEST(ToleranceTest, FollowsTheValueThatAnOptionGives) {
  const scene::Scene scene = with("[tolerance]\n\"plant.mass_kg\" = 0.5\n",
                                  {"plant.mass_kg=2", "friction.normal_force_N=0.1962"});
  EXPECT_EQ(scene.tolerances[0].lowest, 1.0);
  EXPECT_EQ(scene.tolerances[0].highest, 3.0);
}

TEST(ToleranceTest, SaysWhereItIsWrongAndWhatIsAllowed) {
  const std::string forms =
      "; allowed: a half width relative to the value, above 0, at most 100, { normal = deviation } "
      "or { range = [lowest, highest] }";
  const std::string place = "s.toml:22:29: tolerance.plant.stiffness_N_per_m: ";
  const auto of_stiffness = [](const std::string& value) {
    return tolerance_error("\"plant.stiffness_N_per_m\" = " + value);
  };
  EXPECT_EQ(of_stiffness("\"4 %\""), place + "is a string" + forms);
  EXPECT_EQ(of_stiffness("{}"), place + "is another table" + forms);
  EXPECT_EQ(of_stiffness("{ normal = 0.1, range = [1, 2] }"), place + "is another table" + forms);
  EXPECT_EQ(of_stiffness("{ range = 3 }"), place + "is a range that is an integer" + forms);
  EXPECT_EQ(of_stiffness("{ range = [1, 2, 3] }"), place + "is a range of 3 values" + forms);
  EXPECT_EQ(of_stiffness("{ range = [2, 1] }"),
            place + "2 is not below 1; allowed: the lowest, then the highest");
  EXPECT_EQ(of_stiffness("0"), place + "0 is out of range; allowed: above 0, at most 100");
  EXPECT_EQ(of_stiffness("nan"), place + "is not finite; allowed: a number, above 0, at most 100");
  EXPECT_EQ(of_stiffness("1.5"), place +
                                     "1.5 leaves the range of plant.stiffness_N_per_m, 0 to 1e+18 "
                                     "N/m; allowed: at most 1");
  EXPECT_EQ(tolerance_error("\"plant.mass_kg\" = 1"),
            "s.toml:22:19: tolerance.plant.mass_kg: 1 leaves the range of plant.mass_kg, 1e-12 to "
            "1e+06 kg; allowed: at most 0.999999");
  EXPECT_EQ(of_stiffness("{ range = [-1, 2] }"),
            "s.toml:22:40: tolerance.plant.stiffness_N_per_m[0]: -1 is out of range; allowed: 0 to "
            "1e+18 N/m");
  EXPECT_EQ(of_stiffness("{ normal = -0.1 }"),
            "s.toml:22:40: tolerance.plant.stiffness_N_per_m: -0.1 is out of range; allowed: above "
            "0, at most 100");
}

TEST(ToleranceTest, IsOfANumberThatTheSceneHas) {
  EXPECT_EQ(tolerance_error("\"plant.damping_N_s_per_m\" = 0.1"),
            "s.toml:22:29: tolerance.plant.damping_N_s_per_m: is relative to "
            "plant.damping_N_s_per_m, which is 0; allowed: { range = [lowest, highest] }");
  EXPECT_EQ(tolerance_error("\"transducer.force_factor_N_per_V\" = 0.1"),
            "s.toml:22:1: tolerance.transducer.force_factor_N_per_V: not used here: the scene has "
            "no value of it; remove it");
  EXPECT_EQ(error_of("[tolerance]\n\"plant.stiffness_N_per_m\" = 0.1\n",
                     {"plant.stiffness_N_per_m=", "plant.stiffness_profile=[[0, 133e6]]"}),
            "s.toml:22:1: tolerance.plant.stiffness_N_per_m: not used here: the scene has "
            "plant.stiffness_profile in its place, which stays as it is; remove it");
  EXPECT_EQ(tolerance_error("\"plant.stiffnes_N_per_m\" = 0.1"),
            "s.toml:22:1: tolerance.plant.stiffnes_N_per_m: unknown key; did you mean "
            "plant.stiffness_N_per_m?");
  for (const char* fixed : {"friction.law", "sensor.force_full_scale_N", "controller.arithmetic"}) {
    EXPECT_NE(tolerance_error(fmt::format("\"{}\" = 0.1", fixed))
                  .find(fmt::format("tolerance.{}: is no number that the true plant may have "
                                    "otherwise; allowed: plant.mass_kg, ",
                                    fixed)),
              std::string::npos)
        << fixed;
  }
  EXPECT_NE(
      tolerance_error("plant.mass_kg = 0.1").find("s.toml:22:1: tolerance.plant: unknown key"),
      std::string::npos);
  EXPECT_NE(tolerance_error("\"sensor.adc_bits\" = 0.1")
                .find("is a real number; allowed: { range = [lowest, highest] } of integers"),
            std::string::npos);
  EXPECT_EQ(
      error_of("[tolerance]\n\"plant.mass_kg\" = 0.1\n[true_values]\n\"plant.mass_kg\" = 1\n"),
      "s.toml:22:19: tolerance.plant.mass_kg: excludes true_values.plant.mass_kg; allowed: one "
      "of the two");
}

TEST(TrueValuesTest, AreThePlantsAndTheRestIsBelieved) {
  const auto [plant, nominal, design] = experiment::read_text(
      scene_text + "[true_values]\n\"plant.mass_kg\" = 0.03\n\"sensor.adc_bits\" = 9\n", "s");
  EXPECT_EQ(plant.plant.mass_kg, 0.03);
  EXPECT_EQ(plant.sensor.adc_bits, 9);
  EXPECT_EQ(nominal.plant.mass_kg, 0.02);
  EXPECT_EQ(nominal.sensor.adc_bits, 12);
  EXPECT_DOUBLE_EQ(plant.friction.normal_force_N, 0.02 * 9.81)
      << "what follows by default follows from the scene's value";
  EXPECT_EQ(plant.sensor.force_full_scale_N, nominal.sensor.force_full_scale_N);
}

TEST(TrueValuesTest, SayWhereTheyAreWrong) {
  EXPECT_EQ(error_of("[true_values]\n\"plant.mass_kg\" = -1\n"),
            "s.toml:22:19: true_values.plant.mass_kg: -1 is out of range; allowed: 1e-12 to 1e+06 "
            "kg");
  EXPECT_EQ(
      error_of("[true_values]\n\"transducer.loss_tangent\" = 1\n"),
      "s.toml:22:1: true_values.transducer.loss_tangent: not used here: the scene has no value "
      "of it; remove it");
  // A range that follows from other keys.
  EXPECT_EQ(error_of("[true_values]\n\"friction.initial_force_N\" = 7\n")
                .find("s.toml:22:30: friction.initial_force_N: 7 is out of range; allowed: "),
            0U);
  // A plant that cannot be: no friction.
  EXPECT_NE(error_of("[true_values]\n\"friction.coefficient\" = 0\n")
                .find("there is no friction to control"),
            std::string::npos);
}

TEST(TrueValuesTest, MayStandForWhatTheDocumentVaries) {
  const Document document({"s.toml", scene_text}, {}, {"true_values.plant.stiffness_N_per_m"});
  const scene::Scene stated = with("");
  const scene::Scene truth = read_truth(document, {VariedValue(130e6)}, stated);
  EXPECT_EQ(truth.plant.stiffness_N_per_m, 130e6);
  EXPECT_EQ(stated.plant.stiffness_N_per_m, 133e6);
  ASSERT_EQ(truth.true_values.size(), 1U);
  EXPECT_EQ(truth.true_values[0].value, 130e6);
}

}  // namespace
}  // namespace sonoglide::scene_file::tolerances_test
