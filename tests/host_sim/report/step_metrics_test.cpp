#include "host_sim/report/step_metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "host_sim/report/words.hpp"
#include "periods.hpp"

namespace sonoglide::report::step_metrics_test {
namespace {

using scene::Scene;

std::vector<StepMetrics> step_metrics(const Scene& scene,
                                      const std::vector<loop::Period>& periods) {
  StepMeter meter(scene, configure::ControlDesign{});
  for (const loop::Period& period : periods) {
    meter.take(period);
  }
  return meter.steps();
}

StepMetrics only_step(const Scene& scene, const std::vector<loop::Period>& periods) {
  const std::vector<StepMetrics> all = step_metrics(scene, periods);
  EXPECT_EQ(all.size(), 1U);
  return all.at(0);
}

/// One step to `target` from 0 on, 100 periods.
StepMetrics one_step(double target, const std::function<double(int)>& ratio) {
  const Scene scene = made_up_scene({{0.0, target}}, 0.1);
  return only_step(scene, made_up_run(scene, ratio));
}

TEST(StepMetricsTest, SettlesWhenItIsInsideTheBandForGood) {
  const StepMetrics step = one_step(0.5, [](int k) { return k < 7 ? 0.6 : 0.5; });
  ASSERT_TRUE(step.settling_time_s);
  EXPECT_NEAR(*step.settling_time_s, 7e-3, 1e-12);
  EXPECT_EQ(step.time_s, 0.0);
  EXPECT_EQ(step.target, 0.5);
  EXPECT_NEAR(step.steady_error, 0.0, 1e-15);
  EXPECT_EQ(step.ripple, 0.0);
  EXPECT_NEAR(step.drive_amplitude_N, 100.0, 1e-12);
  EXPECT_EQ(step.limit, control::Limit::none);
}

TEST(StepMetricsTest, ALaterExcursionPutsSettlingOff) {
  const StepMetrics step = one_step(0.5, [](int k) { return k == 0 || k == 41 ? 0.489 : 0.5; });
  ASSERT_TRUE(step.settling_time_s);
  EXPECT_NEAR(*step.settling_time_s, 42e-3, 1e-12);
}

/// A resonant loop that vibrates at 0.1 m/s, wanted and reached but for the first periods.
std::vector<loop::Period> resonant_run(Scene& scene, double ratio) {
  scene.controller->vibration = scene::VibrationControl::resonant;
  scene.sensor.vibration = scene::VibrationSensor::velocity;
  std::vector<loop::Period> periods = made_up_run(scene, [ratio](int) { return ratio; });
  for (std::size_t k = 0; k < periods.size(); ++k) {
    periods[k].wanted_vibration_m_per_s = 0.1;
    periods[k].vibration_m_per_s = {k < 7 ? 0.097 : 0.0, k < 7 ? 0.0 : 0.101};
    periods[k].natural_Hz = 1000.0;
    periods[k].frequency_Hz = k == 80 ? 999.0 : 1000.5;
  }
  return periods;
}

TEST(StepMetricsTest, TellsHowAResonantLoopHeldTheVibration) {
  Scene scene = made_up_scene({{0.0, 0.5}}, 0.1);
  const std::vector<loop::Period> periods = resonant_run(scene, 0.5);
  const StepMetrics step = only_step(scene, periods);
  ASSERT_TRUE(step.resonance);
  EXPECT_NEAR(step.vibration->velocity_m_per_s, 0.101, 1e-12);
  ASSERT_TRUE(step.vibration->settling_time_s);
  EXPECT_NEAR(*step.vibration->settling_time_s, 7e-3, 1e-12);
  EXPECT_NEAR(step.resonance->frequency_error, 1e-3, 1e-12);
  EXPECT_NEAR(step.resonance->frequency_Hz, (24.0 * 1000.5 + 999.0) / 25.0, 1e-9);
}

TEST(StepMetricsTest, AHeldVibrationOffTargetWithoutAForceSensorIsAMismatch) {
  Scene scene = made_up_scene({{0.0, 0.5}}, 0.1);
  const std::vector<loop::Period> periods = resonant_run(scene, 0.6);
  EXPECT_EQ(only_step(scene, periods).limit, control::Limit::not_settling);
  scene.sensor.force = false;
  const StepMetrics step = only_step(scene, periods);
  EXPECT_EQ(step.limit, control::Limit::mismatch);
  EXPECT_FALSE(step.limit_seen_by_controller);
}

TEST(StepMetricsTest, TheBandsEdgeIsInside) {
  const StepMetrics step = one_step(0.5, [](int k) { return k % 2 == 0 ? 0.5099999 : 0.4900001; });
  ASSERT_TRUE(step.settling_time_s);
  EXPECT_EQ(*step.settling_time_s, 0.0);
}

TEST(StepMetricsTest, NeverSettlesWhereTheLastPeriodIsOutside) {
  EXPECT_FALSE(one_step(0.5, [](int k) { return k == 99 ? 0.52 : 0.5; }).settling_time_s);
  EXPECT_FALSE(one_step(0.5, [](int) { return 0.7; }).settling_time_s);
  EXPECT_FALSE(one_step(0.5, [](int) { return std::nan(""); }).settling_time_s);
}

TEST(StepMetricsTest, SettlesOnlyWhereATenthOfTheStepIsInsideTheBand) {
  const StepMetrics late = one_step(0.5, [](int k) { return k < 90 ? 0.52 : 0.5; });
  ASSERT_TRUE(late.settling_time_s);
  EXPECT_NEAR(*late.settling_time_s, 90e-3, 1e-12);
  const StepMetrics too_late = one_step(0.5, [](int k) { return k < 91 ? 0.52 : 0.5; });
  EXPECT_FALSE(too_late.settling_time_s);
  EXPECT_EQ(too_late.limit, control::Limit::not_settling);
  EXPECT_FALSE(too_late.limit_seen_by_controller);
}

TEST(StepMetricsTest, ATenthIsOfWhatCalibrationLeavesOfTheStep) {
  Scene scene = made_up_scene({{0.0, 0.5}}, 0.1);
  scene.controller->calibration_s = 50e-3;
  const auto step_inside_from = [&scene](int first) {
    return only_step(scene, made_up_run(scene, [first](int k) { return k < first ? 0.52 : 0.5; }));
  };
  EXPECT_TRUE(step_inside_from(95).settling_time_s);
  EXPECT_FALSE(step_inside_from(96).settling_time_s);
}

/// A step of this course in which the controller takes its reading for settled, or has not decided.
StepMetrics judged_step(control::Settling judgement, const std::function<double(int)>& ratio) {
  const Scene scene = made_up_scene({{0.0, 0.5}}, 0.1);
  std::vector<loop::Period> periods = made_up_run(scene, ratio);
  for (loop::Period& period : periods) {
    period.settling = judgement;
  }
  return only_step(scene, periods);
}

TEST(StepMetricsTest, TellsWhyTheTrueRatioDoesNotSettle) {
  for (const control::Settling judgement :
       {control::Settling::settled, control::Settling::pending}) {
    const StepMetrics rings =
        judged_step(judgement, [](int k) { return k % 2 == 0 ? 0.48 : 0.52; });
    EXPECT_EQ(rings.limit, control::Limit::not_settling);
    EXPECT_EQ(rings.cause, control::Settling::ringing);
    EXPECT_EQ(rings.controller_undecided, judgement == control::Settling::pending);
  }
  const StepMetrics stays_outside =
      judged_step(control::Settling::pending, [](int k) { return k < 95 ? 0.513 : 0.505; });
  EXPECT_EQ(stays_outside.cause, control::Settling::offset);
  const StepMetrics leaves_once =
      judged_step(control::Settling::settled, [](int k) { return k == 95 ? 0.511 : 0.5; });
  EXPECT_EQ(leaves_once.limit, control::Limit::not_settling);
  EXPECT_EQ(leaves_once.cause, control::Settling::pending) << "none is known";
}

TEST(StepMetricsTest, AnOffsetIsAMismatchOnlyWhereTheReadingHasSettled) {
  const auto off = [](int) { return 0.6; };
  const StepMetrics settled = judged_step(control::Settling::settled, off);
  EXPECT_EQ(settled.limit, control::Limit::mismatch);
  EXPECT_EQ(settled.cause, control::Settling::pending);
  EXPECT_EQ(limit_text(settled), "mismatch, not detected by the controller");
  const StepMetrics pending = judged_step(control::Settling::pending, off);
  EXPECT_EQ(pending.limit, control::Limit::not_settling);
  EXPECT_EQ(limit_text(pending), "not_settling (offset), not yet judged by the controller");
  StepMetrics swallowed = pending;
  swallowed.steady_error = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(limit_text(swallowed), "not_settling, no carrier period to judge it by");
}

TEST(StepMetricsTest, ALateStepKeepsTheLimitThatTheControllerNames) {
  const Scene scene = made_up_scene({{0.0, 0.5}}, 0.1);
  std::vector<loop::Period> periods = made_up_run(scene, [](int k) { return k < 95 ? 0.52 : 0.5; });
  for (std::size_t k = 75; k < 80; ++k) {
    periods[k].limit = control::Limit::actuator;
  }
  const StepMetrics step = only_step(scene, periods);
  EXPECT_FALSE(step.settling_time_s);
  EXPECT_EQ(step.limit, control::Limit::actuator);
  EXPECT_TRUE(step.limit_seen_by_controller);
}

TEST(StepMetricsTest, ASettledStepThatTheControllerDoubtsIsToldSo) {
  StepMetrics step;
  step.settling_time_s = 1e-3;
  step.limit = control::Limit::not_settling;
  step.cause = control::Settling::offset;
  step.limit_seen_by_controller = true;
  EXPECT_EQ(limit_text(step), "not_settling (offset), in the controller's reading alone");
  step.settling_time_s.reset();
  EXPECT_EQ(limit_text(step), "not_settling (offset)");
}

TEST(StepMetricsTest, TheVibrationSettlesOnlyForATenthOfTheStep) {
  Scene scene = made_up_scene({{0.0, 0.5}}, 0.1);
  std::vector<loop::Period> periods = resonant_run(scene, 0.5);
  periods[89].vibration_m_per_s = 0.09;
  EXPECT_TRUE(only_step(scene, periods).vibration->settling_time_s);
  periods[90].vibration_m_per_s = 0.09;
  EXPECT_FALSE(only_step(scene, periods).vibration->settling_time_s);
}

TEST(StepMetricsTest, OvershootIsBeyondTheTargetOnTheWayDown) {
  const StepMetrics step = one_step(0.4, [](int k) {
    return k == 0 ? 1.0 : k == 3 ? 0.37 : k == 4 ? 0.45 : 0.4;
  });
  EXPECT_NEAR(step.overshoot, 0.03, 1e-12);
}

TEST(StepMetricsTest, OvershootIsBeyondTheTargetOnTheWayUp) {
  const Scene scene = made_up_scene({{0.0, 0.4}, {0.05, 0.6}}, 0.1);
  const auto steps = step_metrics(scene, made_up_run(scene, [](int k) {
                                    return k < 50 ? 0.4 : k == 52 ? 0.67 : k == 53 ? 0.5 : 0.6;
                                  }));
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[0].overshoot, 0.0);
  EXPECT_NEAR(steps[1].overshoot, 0.07, 1e-12);
  EXPECT_NEAR(*steps[1].settling_time_s, 4e-3, 1e-12);
  EXPECT_EQ(steps[1].time_s, 0.05);
}

TEST(StepMetricsTest, OvershootLeavesOutPeriodsDrivenForTheTargetBefore) {
  const Scene scene = made_up_scene({{0.0, 0.6}, {0.05, 0.4}}, 0.1);
  std::vector<loop::Period> periods = made_up_run(scene, [](int k) {
    return k < 50 ? 0.6 : k == 50 ? 0.3 : 0.4;
  });
  EXPECT_NEAR(step_metrics(scene, periods)[1].overshoot, 0.1, 1e-12);
  periods[50].target = 0.6;
  EXPECT_EQ(step_metrics(scene, periods)[1].overshoot, 0.0);
}

TEST(StepMetricsTest, SteadyErrorAndRippleAreThoseOfTheLastQuarter) {
  const StepMetrics step = one_step(0.5, [](int k) {
    const double wave = k % 2 == 0 ? 0.003 : -0.003;
    return k < 75 ? 0.8 : 0.502 + wave;
  });
  EXPECT_NEAR(step.steady_error, 0.502 - 0.5 + 0.003 * (12 - 13) / 25.0, 1e-12);
  EXPECT_NEAR(step.ripple, 0.003, 1e-12);
}

TEST(StepMetricsTest, APeriodWithoutARatioIsLeftOutOfTheSteadyError) {
  const StepMetrics step = one_step(0.5, [](int k) { return k == 90 ? std::nan("") : 0.502; });
  EXPECT_NEAR(step.steady_error, 0.002, 1e-12);
}

TEST(StepMetricsTest, DriveAmplitudeIsTheMeanOverTheLastQuarter) {
  const Scene scene = made_up_scene({{0.0, 0.5}}, 0.1);
  std::vector<loop::Period> periods = made_up_run(scene, [](int) { return 0.5; });
  for (std::size_t k = 0; k < 100; ++k) {
    periods[k].drive_amplitude_N = static_cast<double>(k);
  }
  EXPECT_NEAR(only_step(scene, periods).drive_amplitude_N, 87.0, 1e-12);
}

TEST(StepMetricsTest, NamesTheLimitOfTheLastQuarter) {
  const Scene scene = made_up_scene({{0.0, 0.5}}, 0.1);
  std::vector<loop::Period> periods = made_up_run(scene, [](int) { return 0.5; });
  for (std::size_t k = 0; k < 75; ++k) {
    periods[k].limit = control::Limit::slew;
  }
  EXPECT_EQ(only_step(scene, periods).limit, control::Limit::none);
  for (std::size_t k = 75; k < 100; ++k) {
    periods[k].limit = k < 80 ? control::Limit::slew : control::Limit::actuator;
  }
  EXPECT_EQ(only_step(scene, periods).limit, control::Limit::actuator);
  for (std::size_t k = 75; k < 100; ++k) {
    periods[k].limit = control::Limit::speed_floor;
  }
  EXPECT_EQ(only_step(scene, periods).limit, control::Limit::speed_floor);
}

TEST(StepMetricsTest, ASettledStepHasTheLimitOfMostPeriods) {
  const Scene scene = made_up_scene({{0.0, 0.5}}, 0.1);
  std::vector<loop::Period> periods = made_up_run(scene, [](int) { return 0.5; });
  for (std::size_t k = 75; k < 87; ++k) {
    periods[k].limit = control::Limit::not_settling;
  }
  EXPECT_EQ(only_step(scene, periods).limit, control::Limit::none);
  periods[87].limit = control::Limit::not_settling;
  EXPECT_EQ(only_step(scene, periods).limit, control::Limit::not_settling);
}

// The controller sees neither: it foresees the current, and the force tells nothing of the contact.
TEST(StepMetricsTest, TheSimulationNamesATrueCurrentAboveItsLimit) {
  Scene scene = made_up_scene({{0.0, 0.5}}, 0.1);
  std::vector<loop::Period> periods = resonant_run(scene, 0.5);
  scene.transducer = scene::Transducer{2.0, 1e-9, 0.0};
  for (loop::Period& period : periods) {
    // Nf v = 2 N/V 0.101 m/s, and 2 pi 1 kHz 1 nF 50 V = 0.3 mA through C0.
    period.current_A = {0.0, 0.202 + 0.0003};
  }
  const auto limit_with = [&](double largest_A) {
    scene.drive->max_current_amplitude_A = largest_A;
    return only_step(scene, periods);
  };
  EXPECT_EQ(limit_with(0.2025).limit, control::Limit::none);
  EXPECT_EQ(limit_with(0.202).limit, control::Limit::current);
  EXPECT_FALSE(limit_with(0.202).limit_seen_by_controller);
  for (loop::Period& period : periods) {
    period.limit = control::Limit::voltage;
  }
  EXPECT_EQ(limit_with(0.202).limit, control::Limit::voltage);
}

TEST(StepMetricsTest, AContactThatOpensIsNamedBeforeAnyOtherLimit) {
  const Scene scene = made_up_scene({{0.0, 0.5}}, 0.1);
  std::vector<loop::Period> periods = made_up_run(scene, [](int) { return 0.5; });
  periods[10].open_fraction = 0.2;
  EXPECT_EQ(only_step(scene, periods).limit, control::Limit::none);
  periods[90].open_fraction = 0.2;
  for (loop::Period& period : periods) {
    period.limit = control::Limit::actuator;
  }
  const StepMetrics step = only_step(scene, periods);
  EXPECT_EQ(step.limit, control::Limit::contact_lost);
  EXPECT_FALSE(step.limit_seen_by_controller);
  EXPECT_EQ(limit_text(step), "contact_lost, not detected by the controller");
}

TEST(StepMetricsTest, WithoutARatioThereIsNoRipple) {
  EXPECT_TRUE(std::isnan(one_step(0.5, [](int) { return std::nan(""); }).ripple));
}

TEST(StepMetricsTest, TheClockStartsWhenCalibrationEnds) {
  Scene scene = made_up_scene({{0.0, 0.5}}, 0.1);
  scene.controller->calibration_s = 20e-3;
  const StepMetrics step =
      only_step(scene, made_up_run(scene, [](int k) { return k < 24 ? 1.0 : 0.5; }));
  ASSERT_TRUE(step.settling_time_s);
  EXPECT_NEAR(*step.settling_time_s, 4e-3, 1e-12);
  EXPECT_EQ(step.time_s, 0.0);
}

TEST(StepMetricsTest, AStepThatCalibrationHasSwallowedIsNotMeasured) {
  Scene scene = made_up_scene({{0.0, 0.3}, {10e-3, 0.6}}, 0.1);
  scene.controller->calibration_s = 20e-3;
  const auto steps =
      step_metrics(scene, made_up_run(scene, [](int k) { return k < 21 ? 1.0 : 0.6; }));
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_FALSE(steps[0].settling_time_s);
  EXPECT_TRUE(std::isnan(steps[0].steady_error));
  EXPECT_TRUE(std::isnan(steps[0].ripple));
  EXPECT_EQ(steps[0].limit, control::Limit::not_settling);
  EXPECT_FALSE(steps[0].limit_seen_by_controller);
  ASSERT_TRUE(steps[1].settling_time_s);
  EXPECT_NEAR(*steps[1].settling_time_s, 1e-3, 1e-12);
  // The ratio came down from 1, whatever the target was during calibration.
  EXPECT_NEAR(steps[1].overshoot, 0.0, 1e-12);
}

TEST(StepMetricsTest, AStepShorterThanFourPeriodsMayHaveNoSteadyPart) {
  const Scene scene = made_up_scene({{0.0, 0.5}, {3.5e-3, 0.6}}, 0.1);
  const auto steps = step_metrics(scene, made_up_run(scene, [](int) { return 0.5; }));
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_NEAR(*steps[0].settling_time_s, 0.0, 1e-12);
  EXPECT_TRUE(std::isnan(steps[0].steady_error));
  EXPECT_TRUE(std::isnan(steps[0].drive_amplitude_N));
}

TEST(StepMetricsTest, AStepAfterTheEndIsLeftOut) {
  const Scene scene = made_up_scene({{0.0, 0.5}, {0.1, 0.6}, {0.2, 0.7}}, 0.1);
  EXPECT_EQ(step_metrics(scene, made_up_run(scene, [](int) { return 0.5; })).size(), 1U);
}

TEST(StepMetricsTest, APeriodThatBelongsToTwoStepsBelongsToNeither) {
  const Scene scene = made_up_scene({{0.0, 0.4}, {50.5e-3, 0.6}}, 0.1);
  const auto steps = step_metrics(scene, made_up_run(scene, [](int k) {
                                    return k < 50 ? 0.4 : k == 50 ? 9.0 : 0.6;
                                  }));
  EXPECT_EQ(steps[0].ripple, 0.0);
  EXPECT_NEAR(*steps[0].settling_time_s, 0.0, 1e-12);
  EXPECT_NEAR(*steps[1].settling_time_s, 0.0, 1e-12);
  EXPECT_EQ(steps[1].overshoot, 0.0);
}

TEST(StepMetricsTest, ALastPeriodThatTheRunCutsShortHasNoRatioOfItsOwn) {
  // The mean over part of a carrier period is not a friction ratio.
  const Scene scene = made_up_scene({{0.0, 0.5}}, 100.4e-3);
  const StepMetrics step =
      only_step(scene, made_up_run(scene, [](int k) { return k < 5 || k == 100 ? 0.9 : 0.5; }));
  ASSERT_TRUE(step.settling_time_s);
  EXPECT_NEAR(*step.settling_time_s, 5e-3, 1e-12);
  EXPECT_EQ(step.ripple, 0.0);
  EXPECT_NEAR(step.steady_error, 0.0, 1e-12);
}

/// A drive at the end that takes the ratio away from its target is there by what the controller believes.
TEST(LimitTextTest, TellsADriveAtTheWrongEnd) {
  using control::Limit;
  StepMetrics step;
  step.target = 0.5;
  step.ripple = 0.01;
  const auto told = [&](Limit limit, double steady_error) {
    step.limit = limit;
    step.steady_error = steady_error;
    return limit_text(step).find("the true value is beyond the target") != std::string::npos;
  };
  for (const Limit limit : {Limit::actuator, Limit::voltage, Limit::current}) {
    EXPECT_TRUE(told(limit, -0.1));
    EXPECT_FALSE(told(limit, 0.1));
    EXPECT_FALSE(told(limit, -0.005));
  }
  EXPECT_TRUE(told(Limit::ratio_end, 0.1));
  EXPECT_FALSE(told(Limit::ratio_end, -0.1));
  EXPECT_FALSE(told(Limit::mismatch, -0.1));
  step.settling_time_s = 1e-3;
  EXPECT_FALSE(told(Limit::actuator, -0.1));
}

}  // namespace
}  // namespace sonoglide::report::step_metrics_test
