/// What keeps the natural mode quiet where the amplitude passes linearly from one carrier period to
/// the next.
#include "host_sim/configure/vibration/ramp_design.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/common/table_1.hpp"

namespace sonoglide::configure::ramp_design_test {
namespace {

using tests::with_natural_frequency;

/// Table 1 on another spring, its amplitude ramped, with nothing said about shaping.
scene::Scene ramped(double mode_per_carrier) {
  scene::Scene scene = with_natural_frequency(mode_per_carrier);
  scene.drive->interpolation = scene::Interpolation::linear;
  scene.drive->max_force_amplitude_N *= 1.2 * std::abs(1.0 - mode_per_carrier * mode_per_carrier);
  scene.controller->shaping.reset();
  return scene;
}

scene::Tolerance stiffness_tolerance(double half_width) {
  return {"plant.stiffness_N_per_m", scene::Spread::half_width, half_width, 1.0,
          1.0 - half_width,          1.0 + half_width};
}

/// As good as exactly.
scene::Scene ramped_and_known(double mode_per_carrier) {
  scene::Scene scene = ramped(mode_per_carrier);
  scene.tolerances = {stiffness_tolerance(1e-13)};
  return scene;
}

FeedforwardDesign design_of(const scene::Scene& scene) {
  return *design_control(scene).in_mode<FeedforwardDesign>();
}

TEST(RampDesignTest, GivesFeedbackBesideAMultipleAGainThatAdapts) {
  for (const double mode : {1.92, 2.0, 2.05, 2.95, 3.08, 4.003}) {
    const ControlDesign design = design_control(ramped(mode));
    ASSERT_TRUE(design.adaptive_gain) << mode;
    // 4 (D + 1), D of a period's answer, the drive's delay, and ramp and notch.
    EXPECT_EQ(design.adaptive_gain->patience_periods, 4.0 * (3.0 + design.changing_periods()))
        << mode;
    EXPECT_LT(design.adaptive_gain->least_part, 1.0);
    // An eighth of the band, on base 2.
    EXPECT_NEAR(design.adaptive_gain->small_error, 0.0625 * ramped(mode).run.settling_band, 1e-12);
  }
  scene::Scene late = ramped(2.0);
  late.drive->delay_periods += 3;
  EXPECT_EQ(design_control(late).adaptive_gain->patience_periods, 28);
}

TEST(RampDesignTest, LeavesTheGainOfOtherModesAlone) {
  for (const double mode : {0.47, 0.9, 1.5, 1.88, 2.12, 2.5, 3.5}) {
    EXPECT_FALSE(design_control(ramped(mode)).adaptive_gain) << mode;
  }
  scene::Scene damped = ramped(2.01);
  damped.plant.damping_N_s_per_m =
      2.0 * 0.05 * std::sqrt(damped.plant.mass_kg * damped.plant.stiffness_N_per_m);
  EXPECT_FALSE(design_control(damped).adaptive_gain);
  scene::Scene stepped = ramped(2.01);
  stepped.drive->interpolation = scene::Interpolation::step;
  EXPECT_FALSE(design_control(stepped).adaptive_gain);
}

struct Choice {
  double mode;
  Quieting quieting;
};

TEST(RampDesignTest, ChoosesByWhereTheModeIs) {
  for (const Choice& each : std::vector<Choice>{{0.47, Quieting::notch},
                                                {0.9, Quieting::notch},
                                                {1.5, Quieting::notch},
                                                {1.98, Quieting::ramp},
                                                {2.0, Quieting::ramp},
                                                {2.01, Quieting::ramp},
                                                {2.064, Quieting::ramp_and_notch},
                                                {2.5, Quieting::ramp_and_notch},
                                                {3.0, Quieting::ramp},
                                                {4.0, Quieting::ramp}}) {
    const FeedforwardDesign found = design_of(ramped_and_known(each.mode));
    EXPECT_EQ(found.quieting, each.quieting) << each.mode;
    EXPECT_LE(found.ratio_swing, 0.01) << each.mode;
    EXPECT_EQ(found.notch.has_value(), each.quieting != Quieting::ramp) << each.mode;
    EXPECT_FALSE(found.free_mode) << each.mode;
  }
}

TEST(RampDesignTest, KeepsTheLoopQuickWhereTheRampIsEnough) {
  scene::Scene stepped = ramped(2.5);
  stepped.drive->interpolation = scene::Interpolation::step;
  stepped.controller->shaping = scene::Shaping::notch;
  const ControlDesign design = design_control(ramped(2.003));
  EXPECT_GT(design.integral_gain, design_control(stepped).integral_gain);
  EXPECT_EQ(design.changing_periods(), 1.0);
}

TEST(RampDesignTest, AnUncertainModeIsLeftToTheRampUnlessANotchHalvesWhatItLeaves) {
  scene::Scene scene = ramped_and_known(2.04);
  EXPECT_EQ(design_of(scene).quieting, Quieting::ramp_and_notch);
  scene.tolerances = {stiffness_tolerance(0.03)};
  const FeedforwardDesign uncertain = design_of(scene);
  EXPECT_EQ(uncertain.quieting, Quieting::ramp);
  EXPECT_NEAR(uncertain.frequency_range, 1.0 - std::sqrt(0.97), 1e-12);
  EXPECT_GT(uncertain.left, design_of(ramped_and_known(2.04 * std::sqrt(1.03))).left);
  EXPECT_EQ(design_of(ramped_and_known(2.064)).notch->span(), 6);
}

TEST(RampDesignTest, WithoutTolerancesTheModeMayBeOffByOnePercent) {
  const scene::Scene scene = ramped(2.04);
  EXPECT_EQ(design_of(scene).frequency_range, 0.01);
  scene::Scene wrong = scene;
  wrong.model_error.stiffness = 0.8;  // is hidden from the design, but for what the stiffness does
  EXPECT_EQ(design_of(wrong).frequency_range, 0.01);
}

TEST(RampDesignTest, AModeThatMayBeOffGetsTheWiderNotch) {
  scene::Scene scene = ramped(2.1);
  scene.tolerances = {stiffness_tolerance(0.03)};
  const FeedforwardDesign found = design_of(scene);
  ASSERT_TRUE(found.notch);
  EXPECT_EQ(found.notch->tap_count, 5U);
  EXPECT_LE(found.ratio_swing, scene.run.settling_band);
}

TEST(RampDesignTest, TwoCodesAPeriodAreNoRampBesideAnOddMultiple) {
  scene::Scene scene = ramped(3.02);
  EXPECT_EQ(design_of(scene).quieting, Quieting::ramp);
  scene.drive->codes_per_period = 2;
  EXPECT_NE(design_of(scene).quieting, Quieting::ramp);
}

TEST(RampDesignTest, ANotchThatBringsTheSwingIntoTheBandIsTakenThoughItHalvesNothing) {
  scene::Scene scene = ramped(2.064);
  scene.drive->codes_per_period = 4;
  const FeedforwardDesign found = design_of(scene);
  EXPECT_EQ(found.quieting, Quieting::ramp_and_notch);
  EXPECT_LE(found.ratio_swing, scene.run.settling_band);
  scene.controller->shaping = scene::Shaping::none;
  const FeedforwardDesign bare = design_of(scene);
  EXPECT_GT(bare.ratio_swing, scene.run.settling_band);
  EXPECT_LT(bare.left, 2.0 * found.left);
}

TEST(RampDesignTest, TakesTheShapingThatASceneNames) {
  scene::Scene scene = ramped(2.5);
  scene.controller->shaping = scene::Shaping::none;
  const ControlDesign bare = design_control(scene);
  EXPECT_FALSE(bare.notch());
  EXPECT_LT(bare.integral_gain, 0.01);
  scene.controller->shaping = scene::Shaping::robust;
  EXPECT_EQ(design_control(scene).notch()->tap_count, 5U);
  scene::Scene beside = ramped(2.01);
  beside.controller->shaping = scene::Shaping::notch;
  EXPECT_EQ(design_of(beside).quieting, Quieting::ramp_and_notch);
}

TEST(RampDesignTest, SaysWhatItChoseAndWhatIsLeft) {
  const auto note = [](double mode) {
    return design_notes(design_control(ramped_and_known(mode))).front();
  };
  EXPECT_NE(
      note(2.01).find("by the ramp of the drive alone. A change of the amplitude leaves a free "
                      "vibration of up to 0.82 % of its forced one"),
      std::string::npos)
      << note(2.01);
  EXPECT_NE(
      note(2.5).find("by the ramp of the drive and a notch of 3 taps over 2 carrier periods. A "
                     "change of the amplitude leaves no free vibration."),
      std::string::npos)
      << note(2.5);
  EXPECT_NE(note(0.9).find("drive.interpolation = \"step\" is as good"), std::string::npos);
}

TEST(RampDesignTest, AMassWithoutASpringHasNothingToQuiet) {
  scene::Scene scene = ramped(2.5);
  scene.plant.stiffness_N_per_m = 0.0;
  const FeedforwardDesign found = design_of(scene);
  EXPECT_EQ(found.quieting, Quieting::nothing);
  EXPECT_EQ(found.left, 0.0);
}

}  // namespace
}  // namespace sonoglide::configure::ramp_design_test
