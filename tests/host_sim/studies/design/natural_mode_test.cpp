/// What a design tells of the natural mode, of the controller that holds it, and of the carrier.

#include "host_sim/studies/design/natural_mode.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "host_sim/studies/design/report.hpp"
#include "host_sim/studies/design/study.hpp"
#include "tests/common/csv/csv.hpp"
#include "tests/host_sim/loop/steady/scenes/steady_scenes.hpp"

namespace sonoglide::design::natural_mode_test {
namespace {

using steady::normal;
using steady::table_1;
using steady::transverse;

constexpr double sliding_m_per_s = 0.02672;

/// Table 1 on a spring that puts the natural mode 0.010 carrier frequencies above twice the carrier.
scene::Scene beside_a_multiple() {
  scene::Scene scene = table_1();
  scene.plant.stiffness_N_per_m = 11.484e9;
  scene.drive->max_force_amplitude_N = 6000.0;
  scene.drive->codes_per_period = 8;
  return scene;
}

NaturalModeStudy study_of(const scene::Scene& scene) {
  return *natural_mode_study(scene, {0.4, 0.6}, sliding_m_per_s);
}

TEST(NaturalModeTest, TellsWhereTheModeIsAndWhatKeepsItQuiet) {
  const NaturalModeStudy found = study_of(beside_a_multiple());
  EXPECT_NEAR(found.natural_Hz, std::sqrt(11.484e9 / 0.02) / (2.0 * tests::pi), 1e-6);
  EXPECT_NEAR(found.carriers[found.own].from_multiple, 0.010, 5e-4);
  ASSERT_EQ(found.drives.size(), 2U);
  EXPECT_EQ(found.drives[0].interpolation, scene::Interpolation::step);
  EXPECT_EQ(found.drives[1].quieting, configure::Quieting::ramp);
  EXPECT_LT(found.drives[1].left.left, 0.05);
  EXPECT_EQ(found.drives[0].plants.never, found.plants);
  EXPECT_GT(found.drives[1].plants.settled, 2U);
  EXPECT_EQ(found.best_drive, 1U);
}

TEST(NaturalModeTest, RecommendsACarrierAtWhichEveryPlantSettles) {
  const NaturalModeStudy found = study_of(beside_a_multiple());
  EXPECT_TRUE(found.assumed_range);
  EXPECT_NEAR(found.stiffness_range, 0.02, 1e-12);
  EXPECT_GT(found.carriers[found.own].plants.never, 0U);
  ASSERT_TRUE(found.recommended);
  const CarrierPoint& best = found.carriers[*found.recommended];
  EXPECT_GT(best.plants.settled, found.carriers[found.own].plants.settled);
  EXPECT_GT(best.from_multiple, 0.05);
  for (const CarrierPoint& point : found.carriers) {
    EXPECT_EQ(point.plants.settled + point.plants.late + point.plants.never,
              point.reachable ? found.plants : 0U);
  }
}

TEST(NaturalModeTest, KeepsACarrierThatIsFarFromTrouble) {
  const NaturalModeStudy found = study_of(table_1());
  ASSERT_TRUE(found.recommended);
  EXPECT_EQ(*found.recommended, found.own);
  EXPECT_GE(found.carriers[found.own].plants.settled, found.plants - 1);
  EXPECT_EQ(found.drives[0].quieting, configure::Quieting::notch);
}

TEST(NaturalModeTest, RecommendsABiasAgainstASlowMode) {
  scene::Scene slow = table_1();
  slow.plant.stiffness_N_per_m = 2.558e6;  // 0.03 of the carrier
  slow.drive->max_force_amplitude_N = 2200.0;
  const NaturalModeStudy found = study_of(slow);
  ASSERT_TRUE(found.bias);
  // 2 Fc, and g a F/2π of the jump of full drive.
  EXPECT_NEAR(found.bias->limit_N, 0.039 + 0.33 * 0.03 * 2200.0 / (2.0 * tests::pi), 0.05);
  EXPECT_EQ(found.bias->plants.settled, found.plants);
  EXPECT_FALSE(study_of(table_1()).bias);
  EXPECT_FALSE(study_of(beside_a_multiple()).bias);
}

TEST(NaturalModeTest, RecommendsTheLoopThatSuitsTheMode) {
  const NaturalModeStudy beside = study_of(beside_a_multiple());
  EXPECT_TRUE(beside.recommended_loop.means.ramped());
  EXPECT_EQ(beside.recommended_loop.refused, "");
  EXPECT_EQ(beside.recommended_loop.means.codes_per_period, 2);
  EXPECT_EQ(beside.recommended_loop.plants.never, 0U);

  scene::Scene slow = table_1();
  slow.plant.stiffness_N_per_m = 2.558e6;  // 0.03 of the carrier
  slow.drive->max_force_amplitude_N = 2200.0;
  const NaturalModeStudy moved = study_of(slow);
  EXPECT_TRUE(moved.recommended_loop.means.sensorless);
  EXPECT_NEAR(moved.recommended_loop.bias_limit_N, moved.bias->limit_N, 1e-12);
  EXPECT_EQ(moved.recommended_loop.plants.never, 0U);

  scene::Scene usual = table_1();
  usual.controller->arithmetic = scene::Arithmetic::q15;
  const NaturalModeStudy other = study_of(usual);
  EXPECT_TRUE(other.recommended_loop.means.sensorless);
  EXPECT_EQ(other.recommended_loop.bias_limit_N, 0.0);
  EXPECT_EQ(other.recommended_loop.plants.settled, other.plants);
}

TEST(NaturalModeTest, RecommendsARobustNotchWhereTheRampLeavesMost) {
  scene::Scene scene = table_1();
  scene.plant.stiffness_N_per_m = 31.6e9;  // 3.34 of the carrier
  scene.drive->max_force_amplitude_N = 16000.0;
  scene.controller->shaping_range = 0.2;
  scene.controller->shaping = scene::Shaping::robust;
  const RecommendedLoop found = study_of(scene).recommended_loop;
  EXPECT_EQ(found.refused, "");
  EXPECT_EQ(found.plants.never, 0U);
  EXPECT_EQ(found.leaves, std::vector<std::string>{});
  const auto range =
      std::find_if(found.lines.begin(), found.lines.end(),
                   [](const SceneLine& line) { return line.key == "shaping_range"; });
  ASSERT_NE(range, found.lines.end());
  EXPECT_EQ(range->value, "0.03");
}

TEST(NaturalModeTest, RecommendsTheSourceOfTheFrictionThatTheFirstTargetLeavesTimeFor) {
  scene::Scene scene = beside_a_multiple();
  scene.controller->target_friction_ratio = {{0.0, 0.5}, {3e-3, 0.4}};
  scene.run.duration_s = 6e-3;
  EXPECT_EQ(study_of(scene).recommended_loop.friction, scene::FrictionSource::calibrated);
  scene.controller->target_friction_ratio = {{0.0, 0.5}, {1e-4, 0.4}};
  EXPECT_EQ(study_of(scene).recommended_loop.friction, scene::FrictionSource::tracked);
}

TEST(NaturalModeTest, GivesAModeSlowerThanAHundredPeriodsTheTimeToComeToRest) {
  scene::Scene slow = table_1();
  slow.plant.stiffness_N_per_m = 1.82e5;  // 0.008 of the carrier
  slow.drive->max_force_amplitude_N = 2200.0;
  const NaturalModeStudy found = study_of(slow);
  EXPECT_NEAR(found.step_periods, 1250, 2);
  const Tally& own = found.carriers[found.own].plants;
  EXPECT_EQ(own.settled + own.late, found.plants);
  EXPECT_EQ(study_of(table_1()).step_periods, 100);
}

TEST(NaturalModeTest, TakesTheToleranceOfTheScene) {
  scene::Scene scene = table_1();
  const double stiffness = scene.plant.stiffness_N_per_m;
  scene.tolerances.push_back({"plant.stiffness_N_per_m", scene::Spread::half_width, 0.02, stiffness,
                              0.98 * stiffness, 1.02 * stiffness});
  const NaturalModeStudy found = study_of(scene);
  EXPECT_FALSE(found.assumed_range);
  EXPECT_NEAR(found.stiffness_range, 0.02, 3e-4);
}

TEST(NaturalModeTest, IsOfNoLoopAtResonance) {
  scene::Scene followed = table_1();
  followed.controller->vibration = scene::VibrationControl::resonant;
  EXPECT_FALSE(natural_mode_study(followed, {0.5}, sliding_m_per_s));
}

TEST(NaturalModeTest, RecommendsARampForAVibrationThatTheFrictionDoesNotShow) {
  for (const scene::Scene& scene : {transverse(), normal()}) {
    const NaturalModeStudy found = study_of(scene);
    const RecommendedLoop& loop = found.recommended_loop;
    EXPECT_EQ(loop.means.kind, configure::ModeKind::across);
    EXPECT_TRUE(loop.means.ramped());
    EXPECT_EQ(loop.refused, "");
    EXPECT_EQ(loop.plants.settled + loop.plants.late + loop.plants.never, found.plants);
    EXPECT_FALSE(found.bias);
  }
  EXPECT_EQ(study_of(transverse()).recommended_loop.plants.never, 0U);
}

TEST(NaturalModeTest, TellsTheLinesThatASceneLacks) {
  const auto lines_of = [](const RecommendedLoop& loop) {
    std::string all;
    for (const SceneLine& line : loop.lines) {
      all += line.table + "." + line.key + " = " + line.value + "\n";
    }
    return all;
  };
  scene::Scene scene = table_1();
  scene.controller->arithmetic = scene::Arithmetic::q15;
  scene.controller->shaping = scene::Shaping::robust;
  scene.controller->shaping_range = 0.02;
  scene.controller->calibration_s = 0.5e-3;
  const RecommendedLoop other = study_of(scene).recommended_loop;
  EXPECT_TRUE(other.unnamed);
  EXPECT_EQ(lines_of(other),
            "controller.vibration = \"damped\"\ncontroller.friction = \"calibrated\"\n"
            "controller.arithmetic = \"q31\"\n");
  EXPECT_EQ(other.leaves,
            (std::vector<std::string>{"controller.shaping", "controller.shaping_range"}));
  scene.controller->every_periods = 2;
  scene.drive->max_force_slew_N_per_s = 3e7;
  EXPECT_EQ(study_of(scene).recommended_loop.leaves,
            (std::vector<std::string>{"controller.shaping", "controller.shaping_range",
                                      "controller.every_periods", "drive.max_force_slew_N_per_s"}));
  scene.controller->vibration = scene::VibrationControl::damped;
  scene.controller->arithmetic = scene::Arithmetic::q31;
  EXPECT_FALSE(study_of(scene).recommended_loop.unnamed);
}

/// The trials are fed forward on a friction that they know, whatever the scene has.
TEST(NaturalModeTest, TriesScenesThatLearnTheirFrictionOrReadNoForce) {
  scene::Scene calibrated = table_1();
  calibrated.controller->friction = scene::FrictionSource::calibrated;
  calibrated.controller->calibration_s = 0.5e-3;
  EXPECT_EQ(study_of(calibrated).recommended_loop.plants.settled, 8U);
  scene::Scene tracked = table_1();
  tracked.controller->friction = scene::FrictionSource::tracked;
  const NaturalModeStudy study = study_of(tracked);
  EXPECT_EQ(study.recommended_loop.friction, scene::FrictionSource::calibrated);
  EXPECT_EQ(study.recommended_loop.refused, "");
  EXPECT_EQ(study.drives[0].plants.settled, study_of(table_1()).drives[0].plants.settled);
  scene::Scene sightless = table_1();
  sightless.controller->vibration = scene::VibrationControl::damped;
  sightless.sensor.vibration = scene::VibrationSensor::velocity;
  sightless.sensor.force = false;
  sightless.sensor.force_full_scale_N = 0.0;
  EXPECT_EQ(study_of(sightless).recommended_loop.plants.settled, 8U);
}

/// What an observer lags behind is taken for a period, however long the delay.
TEST(NaturalModeTest, ABiasIsOfTheLoopThatHasIt) {
  scene::Scene scene = table_1();
  scene.plant.stiffness_N_per_m = 15.4e6;
  for (const int delay_periods : {0, 3, 4}) {
    scene.drive->delay_periods = delay_periods;
    const RecommendedLoop loop = study_of(scene).recommended_loop;
    EXPECT_TRUE(loop.means.biased);
    EXPECT_GT(loop.bias_limit_N, 1.0) << delay_periods;
    EXPECT_EQ(loop.refused, "");
  }
}

// What it calibrates is no error of its model.
TEST(NaturalModeTest, ALoopThatLearnsItsFrictionIsTriedSo) {
  scene::Scene scene = table_1();
  scene.controller->calibration_s = 0.5e-3;
  const RecommendedLoop exact = study_of(scene).recommended_loop;
  scene.model_error.coefficient = 1.3;
  const NaturalModeStudy off = study_of(scene);
  EXPECT_EQ(off.recommended_loop.friction, scene::FrictionSource::calibrated);
  EXPECT_EQ(off.recommended_loop.plants.settled, exact.plants.settled);
  EXPECT_FALSE(off.model_error);
}

TEST(NaturalModeTest, WhatTheSceneCannotHaveIsSaid) {
  scene::Scene scene = table_1();
  scene.sliding.profile = {{0.0, 0.02672}, {3e-3, -0.02672}};
  EXPECT_NE(study_of(scene).recommended_loop.refused.find("sliding.profile"), std::string::npos);
}

/// Of 8 plants at 60 kHz `driven` are those with the best drive, and `looped` with the recommended loop. With the drive
/// `elsewhere` settle at 54 and at 63 kHz.
NaturalModeStudy tried(const Tally& driven, std::size_t elsewhere, std::size_t looped) {
  NaturalModeStudy study;
  study.natural_Hz = 121e3;
  study.plants = 8;
  study.drives.resize(2);
  study.drives[0].plants = driven;
  for (const double frequency_Hz : {54e3, 57e3, 60e3, 63e3}) {
    study.carriers.emplace_back().frequency_Hz = frequency_Hz;
  }
  study.own = 2;
  study.carriers[2].plants = driven;
  study.carriers[0].plants.settled = study.carriers[3].plants.settled = elsewhere;
  study.recommended = recommended_carrier(study);
  study.recommended_loop.means.sensorless = true;
  study.recommended_loop.plants.settled = looped;
  return study;
}

std::string choice(const NaturalModeStudy& study) {
  const Advice told = natural_mode_advice(study).back();
  EXPECT_EQ(told.topic, "Choice");
  return told.sentence;
}

std::string carrier(const NaturalModeStudy& study) {
  const std::vector<Advice> all = natural_mode_advice(study);
  return all.at(all.size() - 2).sentence;
}

/// The rest never settles.
std::string choice(std::size_t driven, std::size_t elsewhere, std::size_t looped) {
  return choice(tried({driven, 0, 8 - driven}, elsewhere, looped));
}

std::string choice_without_loop(std::size_t driven, std::size_t elsewhere) {
  NaturalModeStudy study = tried({driven, 0, 8 - driven}, elsewhere, 0);
  study.recommended_loop.refused = "sliding.profile: it turns";
  return choice(study);
}

TEST(NaturalModeTest, SaysWhichAdviceIsEnough) {
  EXPECT_EQ(
      choice(8, 8, 8),
      "All 8 plants settle within 60 carrier periods with drive.interpolation = \"step\" (no notch) at 60 kHz: "
      "a scene that has this may keep it. The recommended loop is for a stiffness that may be farther off.");
  EXPECT_EQ(
      choice(3, 8, 8),
      "All 8 plants settle within 60 carrier periods with the recommended loop at 60 kHz, 3 of them without it. "
      "Or keep drive.interpolation = \"step\" (no notch) and change the carrier to 63 kHz: one of the two is "
      "enough.");
  EXPECT_EQ(
      choice(3, 2, 8),
      "All 8 plants settle within 60 carrier periods with the recommended loop at 60 kHz, 3 of them without it. "
      "The carrier may stay as it is.");
  EXPECT_EQ(
      choice(3, 8, 7),
      "All 8 plants settle within 60 carrier periods with drive.interpolation = \"step\" (no notch) at 63 kHz, "
      "so the carrier is enough. At 60 kHz 3 do, with the recommended loop 7.");
}

TEST(NaturalModeTest, ACarrierThatSettlesTheLastPlantIsEnough) {
  const NaturalModeStudy study = tried({7, 0, 1}, 8, 6);
  EXPECT_EQ(carrier(study).find("Keep 60 kHz, as no other settles two plants more: of 8"), 0U);
  EXPECT_EQ(carrier(tried({8, 0, 0}, 8, 8)).find("Keep 60 kHz: of 8"), 0U);
  EXPECT_EQ(
      choice(study),
      "All 8 plants settle within 60 carrier periods with drive.interpolation = \"step\" (no notch) at 63 kHz, "
      "so the carrier is enough. At 60 kHz 7 do, with the recommended loop 6.");
}

TEST(NaturalModeTest, SaysWhatToBeginWithWhereNothingIsEnough) {
  EXPECT_EQ(
      choice(3, 7, 6),
      "Neither the recommended loop nor another carrier settles all 8 plants within 60 carrier periods. Begin "
      "with the carrier 63 kHz, by which 7 settle, and run design again: the loop was tried at 60 kHz alone, the "
      "carriers with drive.interpolation = \"step\" (no notch).");
  EXPECT_NE(choice(0, 0, 6).find("Begin with the recommended loop, by which 6 settle"),
            std::string::npos);
}

TEST(NaturalModeTest, SaysSoWhereNothingSettlesMoreThanTheDrive) {
  EXPECT_EQ(
      choice(3, 2, 3),
      "Neither the recommended loop nor another carrier settles more plants than drive.interpolation = \"step\" "
      "(no notch) at 60 kHz: of 8, 3 settle within 60 carrier periods, 0 later, 5 never.");
  EXPECT_NE(choice(3, 4, 3).find("settles two plants more than drive"), std::string::npos);
  EXPECT_NE(choice(0, 0, 0).find("of 8, 0 settle within 60 carrier periods, 0 later, 8 never."),
            std::string::npos);
}

TEST(NaturalModeTest, TellsWhatTheObserverCostsByTheBudget) {
  std::ifstream file(SONOGLIDE_BUDGET);
  const csv::Table budget({std::istreambuf_iterator<char>(file), {}}, SONOGLIDE_BUDGET);
  const auto row = [&](const std::string& board, const std::string& arithmetic) -> const csv::Row& {
    return *std::find_if(budget.rows().begin(), budget.rows().end(), [&](const csv::Row& each) {
      return each.text("scene") == "damped_by_force" && each.text("board") == board &&
             each.text("arithmetic") == arithmetic;
    });
  };
  const csv::Row& least = row("mps2-an386", "float32");
  const csv::Row& most = row("mps2-an385", "q31");
  const std::string cost =
      fmt::format("{:.0f} to {:.0f} instructions a period and {:.0f} kB",
                  least.number("step_instructions_mean"), most.number("step_instructions_mean"),
                  most.number("flash_bytes") / 1e3);
  const std::string told = natural_mode_advice(tried({7, 1, 0}, 7, 6)).at(2).sentence;
  EXPECT_NE(told.find(cost), std::string::npos) << cost << "\n" << told;
}

// The Controller says then that the drive holds the plant.
TEST(NaturalModeTest, TellsAPlantThatSettlesLateFromOneThatNeverDoes) {
  EXPECT_NE(choice(tried({7, 1, 0}, 7, 6))
                .find("of 8, 7 settle within 60 carrier periods, 1 later, 0 never."),
            std::string::npos);
}

TEST(NaturalModeTest, ChoosesNoLoopThatTheSceneCannotHave) {
  EXPECT_EQ(choice_without_loop(8, 8).find("recommended loop"), std::string::npos);
  EXPECT_EQ(
      choice_without_loop(3, 8),
      "All 8 plants settle within 60 carrier periods with drive.interpolation = \"step\" (no notch) at 63 kHz, "
      "so the carrier is enough. At 60 kHz 3 do. This scene cannot have the recommended loop.");
  EXPECT_EQ(
      choice_without_loop(3, 6),
      "No other carrier settles all 8 plants within 60 carrier periods. Begin with the carrier 63 kHz, by which 6 "
      "settle, and run design again there. This scene cannot have the recommended loop.");
  EXPECT_EQ(
      choice_without_loop(0, 0),
      "No other carrier settles more plants than drive.interpolation = \"step\" (no notch) at 60 kHz: of 8, 0 "
      "settle within 60 carrier periods, 0 later, 8 never. This scene cannot have the recommended loop.");
}

TEST(NaturalModeTest, SaysSoInWordsAndInJson) {
  const DesignStudy study =
      design::study(make_task(configure::make_experiment(beside_a_multiple()), {0.4, 0.6},
                              SpeedRange{sliding_m_per_s, sliding_m_per_s}),
                    [](double) {});
  std::string text;
  for (const Advice& each : advice(study)) {
    text += each.topic + ": " + each.sentence + '\n';
  }
  const auto says = [&](const char* part) { return text.find(part) != std::string::npos; };
  EXPECT_TRUE(says("is 2.01 times the carrier, 0.01 carrier frequencies from 2 times the carrier"))
      << text;
  EXPECT_TRUE(
      says("with drive.interpolation = \"linear\" (the ramp alone) a change of the amplitude is "
           "complete after 1 carrier period and leaves "))
      << text;
  EXPECT_FALSE(says("[model_error]")) << text;
  NaturalModeStudy mistaken = *study.natural_mode;
  mistaken.model_error = true;
  EXPECT_NE(
      natural_mode_advice(mistaken).at(3).sentence.find("on top of the scene's [model_error]"),
      std::string::npos);
  EXPECT_TRUE(
      says("Controller: The best that feeds the drive forward has drive.interpolation = "
           "\"linear\" (the ramp alone): of 8 plants"))
      << text;
  EXPECT_TRUE(says(
      "Recommended: With the force sensor alone, drive.interpolation = \"linear\", "
      "drive.codes_per_period = 2, controller.friction = \"calibrated\": the jumps of two codes a period "
      "hardly excite the mode, whatever the stiffness. Of 8 plants"))
      << text;
  EXPECT_TRUE(says(
      "Keys: For the recommended loop leave out controller.calibration_s, if the scene has them, and write these lines below "
      "the header of each table, in place of lines with the same keys:\n[drive]\ninterpolation = \"linear\"\ncodes_per_period = 2\n"
      "[controller]\nfriction = \"calibrated\"\nController: "))
      << text;
  EXPECT_TRUE(says("Carrier: Use ")) << text;
  const auto json = to_json(study)["natural_mode"];
  EXPECT_EQ(json["drives"][1]["quieted_by"], "ramp");
  const auto& written = json["recommended_loop"]["write"];
  EXPECT_EQ(written["drive"][0], "interpolation = \"linear\"");
  EXPECT_EQ(written["controller"][0], "friction = \"calibrated\"");
  // It is 0.
  EXPECT_EQ(json["recommended_loop"]["remove"].dump(), R"(["controller.calibration_s"])");
  EXPECT_EQ(json["carriers"].size(), study.natural_mode->carriers.size());
}

}  // namespace
}  // namespace sonoglide::design::natural_mode_test
