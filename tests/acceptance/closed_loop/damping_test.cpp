// Closed loops off resonance whose natural mode is seen by a vibration sensor, or felt in the friction,
// and damped, as a scene describes them: with a stiffness that is believed wrong, with a mass that rings already, and in
// every arithmetic.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/report/step_metrics.hpp"
#include "measured_run.hpp"
#include "tests/common/constants/pi.hpp"

namespace sonoglide::damping_test {
namespace {

using tests::two_pi;

/// The contact of Table 1 on springs of any stiffness, under a drive of the same strength.
struct Loop {
  double mode_per_carrier = 0.2163;  ///< Table 1's
  double stiffness_error = 1.0;
  std::string arithmetic = "float32";
  std::string vibration = "vibration = \"damped\"";
  std::string sensor = "[sensor]\nvibration = \"velocity\"\n";
  std::string targets = "[[0.0, 0.4], [2e-3, 0.6], [4e-3, 0.5]]";
  std::string plant;
  double contact_stiffness_N_per_m = 0.056e6;
  std::string friction;
  std::string drive;
  std::string model_error;
  double duration_s = 6e-3;
};

constexpr double carrier_Hz = 60e3;
constexpr double mass_kg = 0.02;
constexpr double full_velocity_m_per_s = 0.267;  ///< ten times the sliding

double stiffness_N_per_m(const Loop& loop) {
  return mass_kg * std::pow(two_pi * carrier_Hz * loop.mode_per_carrier, 2);
}

double largest_force_N(const Loop& loop) {
  const double omega = two_pi * carrier_Hz;
  return full_velocity_m_per_s * std::abs(stiffness_N_per_m(loop) / omega - mass_kg * omega);
}

std::string text_of(const Loop& loop) {
  const bool profile = loop.plant.find("stiffness_profile") != std::string::npos;
  return fmt::format(
      "[plant]\nmass_kg = {}\n{}{}\n"
      "[friction]\nlaw = \"dahl\"\ncoefficient = 0.1\ncontact_stiffness_N_per_m = {}\n{}\n"
      "[sliding]\nvelocity_m_per_s = 0.0267\n"
      "[drive]\nfrequency_Hz = {}\nmax_force_amplitude_N = {:.17g}\n{}\n"
      "[run]\nduration_s = {}\n"
      "[controller]\narithmetic = \"{}\"\n{}\ntarget_friction_ratio = {}\n"
      "{}\n[model_error]\nstiffness = {}\n{}\n",
      mass_kg, profile ? "" : fmt::format("stiffness_N_per_m = {:.17g}\n", stiffness_N_per_m(loop)),
      loop.plant, loop.contact_stiffness_N_per_m, loop.friction, carrier_Hz, largest_force_N(loop),
      loop.drive, loop.duration_s, loop.arithmetic, loop.vibration, loop.targets, loop.sensor,
      loop.stiffness_error, loop.model_error);
}

using Ran = acceptance::MeasuredRun;

Ran run(const Loop& loop) {
  return acceptance::run_measured(experiment::read_text(text_of(loop), "damping.toml").plant);
}

class Damping : public testing::TestWithParam<std::string> {
 protected:
  static Loop loop() {
    Loop loop;
    loop.arithmetic = GetParam();
    return loop;
  }
};

INSTANTIATE_TEST_SUITE_P(Arithmetics, Damping, testing::Values("float64", "float32", "q31"),
                         [](const auto& arithmetic) { return arithmetic.param; });

TEST_P(Damping, SettlesWithAStiffnessThatIsBelievedWrong) {
  for (const double mode : {0.2163, 0.45, 0.7, 0.88, 1.2, 1.55, 2.3}) {
    for (const double error : {0.95, 0.98, 1.0, 1.03, 1.05}) {
      Loop given = loop();
      given.mode_per_carrier = mode;
      given.stiffness_error = error;
      const Ran ran = run(given);
      EXPECT_TRUE(ran.run.result.control->faults.empty());
      for (const report::StepMetrics& step : ran.steps) {
        ASSERT_TRUE(step.settling_time_s) << mode << ' ' << error << ' ' << step.target;
        EXPECT_LE(*step.settling_time_s, 1e-3) << mode << ' ' << error << ' ' << step.target;
        ASSERT_TRUE(step.vibration->settling_time_s);
        EXPECT_LE(*step.vibration->settling_time_s, 1e-3) << mode << ' ' << error;
        EXPECT_LE(std::abs(step.steady_error), 1e-3) << mode << ' ' << error;
        EXPECT_EQ(step.limit, control::Limit::none) << mode << ' ' << error;
        EXPECT_FALSE(step.resonance);
      }
    }
  }
}

TEST_P(Damping, QuietsAMassThatRingsAtFirst) {
  Loop given = loop();
  given.plant = "initial_velocity_m_per_s = 0.05";
  const Ran ran = run(given);
  ASSERT_TRUE(ran.steps[0].settling_time_s);
  EXPECT_LE(*ran.steps[0].settling_time_s, 1e-3);
  // Fed forward it rings for ever.
  given.vibration = "";
  given.sensor = "";
  EXPECT_FALSE(run(given).steps[0].settling_time_s);
}

TEST_P(Damping, QuietsAMassThatIsKnocked) {
  Loop given = loop();
  given.targets = "[[0.0, 0.4], [3e-3, 0.401]]";
  given.friction = "normal_force_profile_N = [[0, 0.1962], [3e-3, 0.1962], [3e-3, 0.25]]";
  given.plant =
      fmt::format("stiffness_profile = [[0, {0:.17g}], [3e-3, {0:.17g}], [3e-3, {1:.17g}]]",
                  stiffness_N_per_m(given), 1.02 * stiffness_N_per_m(given));
  const Ran ran = run(given);
  ASSERT_TRUE(ran.steps[1].vibration->settling_time_s);
  EXPECT_LE(*ran.steps[1].vibration->settling_time_s, 1e-3);
}

TEST_P(Damping, NeedsNoForceSensor) {
  Loop given = loop();
  given.stiffness_error = 1.05;
  given.sensor = "[sensor]\nvibration = \"velocity\"\nvibration_bits = 14\nforce = false\n";
  for (const report::StepMetrics& step : run(given).steps) {
    ASSERT_TRUE(step.settling_time_s);
    EXPECT_LE(*step.settling_time_s, 1e-3);
  }
}

TEST_P(Damping, KeepsToACommandThatActsLater) {
  for (const int delay : {0, 1, 2, 4}) {
    Loop given = loop();
    given.stiffness_error = 0.97;
    given.mode_per_carrier = 0.7;
    given.drive = fmt::format("delay_periods = {}", delay);
    for (const report::StepMetrics& step : run(given).steps) {
      ASSERT_TRUE(step.settling_time_s) << delay;
      EXPECT_LE(*step.settling_time_s, 1e-3) << delay;
    }
  }
}

TEST_P(Damping, NamesATargetOutOfReach) {
  Loop given = loop();
  given.targets = "[[0.0, 0.03]]";
  const Ran ran = run(given);
  EXPECT_EQ(ran.steps[0].limit, control::Limit::actuator);
  EXPECT_TRUE(ran.steps[0].limit_seen_by_controller);
}

TEST_P(Damping, GivesNoDriveForATargetOfOne) {
  Loop given = loop();
  given.targets = "[[0.0, 0.5], [3e-3, 1.0]]";
  const Ran ran = run(given);
  EXPECT_EQ(ran.steps[1].drive_amplitude_N, 0.0);
  ASSERT_TRUE(ran.steps[1].settling_time_s);
  EXPECT_LE(*ran.steps[1].settling_time_s, 1e-3);
}

TEST(DampingTest, FixedPointAgreesWithFloatInEveryPeriod) {
  for (const double mode : {0.2163, 0.8, 1.3, 2.6}) {
    for (const double error : {0.95, 1.0, 1.04}) {
      Loop given;
      given.mode_per_carrier = mode;
      given.stiffness_error = error;
      given.arithmetic = "float64";
      const Ran exact = run(given);
      given.arithmetic = "q31";
      const Ran fixed = run(given);
      ASSERT_EQ(exact.run.periods.size(), fixed.run.periods.size());
      for (std::size_t k = 0; k < exact.run.periods.size(); ++k) {
        ASSERT_NEAR(exact.run.periods[k].friction_ratio, fixed.run.periods[k].friction_ratio, 0.002)
            << mode << ' ' << error << ' ' << k;
      }
      EXPECT_EQ(fixed.run.result.control->signals.empty(), false);
      for (const auto& signal : fixed.run.result.control->signals) {
        EXPECT_EQ(signal.saturations, 0U) << signal.name;
      }
    }
  }
}

/// The same without a vibration sensor: the mode is felt in the friction.
class Feeling : public Damping {
 protected:
  static Loop loop() {
    Loop loop = Damping::loop();
    loop.sensor = "";
    return loop;
  }
};

INSTANTIATE_TEST_SUITE_P(Arithmetics, Feeling, testing::Values("float64", "float32", "q31"),
                         [](const auto& arithmetic) { return arithmetic.param; });

void expect_prompt(const Loop& given) {
  const Ran ran = run(given);
  EXPECT_TRUE(ran.run.result.control->faults.empty());
  for (const report::StepMetrics& step : ran.steps) {
    ASSERT_TRUE(step.settling_time_s) << given.mode_per_carrier << ' ' << given.stiffness_error;
    EXPECT_LE(*step.settling_time_s, 1e-3)
        << given.mode_per_carrier << ' ' << given.stiffness_error << ' ' << step.target;
    EXPECT_LE(std::abs(step.steady_error), 1e-3) << given.mode_per_carrier;
    EXPECT_EQ(step.limit, control::Limit::none) << given.mode_per_carrier;
  }
}

/// Below the carrier, above half of it and above the carrier, where the mode is seen aliased.
TEST_P(Feeling, SettlesWithAStiffnessThatIsBelievedWrong) {
  Loop given = loop();
  for (const double mode : {0.2163, 0.45, 0.7, 0.88, 1.2, 1.55, 2.3}) {
    for (const double error : {0.98, 1.0, 1.03}) {
      given.mode_per_carrier = mode;
      given.stiffness_error = error;
      expect_prompt(given);
    }
  }
  for (const double mode : {0.2163, 0.45, 0.7, 1.2}) {
    for (const double error : {0.95, 1.05}) {
      given.mode_per_carrier = mode;
      given.stiffness_error = error;
      expect_prompt(given);
    }
  }
}

/// A change of the amplitude moves one part of such a mode, which turns by half a turn in a period.
TEST_P(Feeling, SettlesWithAModeOfHalfATurn) {
  Loop given = loop();
  for (const double mode : {0.5, 1.5, 2.5, 3.4966, 3.5, 3.505, 10.5}) {
    given.mode_per_carrier = mode;
    expect_prompt(given);
  }
}

/// A slow mode acts as another sliding speed.
TEST_P(Feeling, HoldsTheRatioWithAModeMuchSlowerThanTheCarrier) {
  Loop given = loop();
  for (const double mode : {0.03, 0.045, 0.06}) {
    given.mode_per_carrier = mode;
    for (const report::StepMetrics& step : run(given).steps) {
      EXPECT_LE(step.ripple, 0.014) << mode << ' ' << step.target;
    }
  }
}

/// At nearly twice the sliding speed, which the friction does not follow linearly.
TEST_P(Feeling, QuietsAMassThatRingsAtFirst) {
  Loop given = loop();
  given.plant = "initial_velocity_m_per_s = 0.05";
  const Ran ran = run(given);
  ASSERT_TRUE(ran.steps[0].settling_time_s);
  EXPECT_LE(*ran.steps[0].settling_time_s, 1.5e-3);
}

/// By default: the drive begins once the contact has slid.
TEST_P(Feeling, LearnsTheFrictionBeforeTheFirstDrive) {
  Loop given = loop();
  for (const char* const coefficient : {"coefficient = 0.7", "coefficient = 1.3"}) {
    given.model_error = coefficient;
    expect_prompt(given);
  }
  // Without calibration the ratio is off by as much as the friction.
  given.vibration += "\ncalibration_s = 0";
  EXPECT_NEAR(run(given).steps[0].steady_error, 0.3 * 0.4, 0.01);
}

/// Next to a multiple of the carrier and without damping a mode rings with the drive, and from then on
/// adds to what the friction shows.
TEST_P(Feeling, HoldsTheRatioWithAModeThatIsOneWithTheVibration) {
  Loop given = loop();
  for (const double mode : {0.0005, 2.0005, 2.9999, 3.9995}) {
    given.mode_per_carrier = mode;
    const report::StepMetrics step = run(given).steps[0];
    ASSERT_TRUE(step.settling_time_s) << mode;
    EXPECT_LE(*step.settling_time_s, 1e-3) << mode;
  }
}

/// The corners of Table 1: stiffness ±5 %, friction ±30 % and learnt, contact ±50 %, 12 bits.
TEST_P(Feeling, SettlesInEveryCornerOfTable1) {
  Loop given = loop();
  given.vibration += "\ncalibration_s = 1e-3";
  given.targets = "[[0.0, 0.4], [3e-3, 0.6], [4.5e-3, 0.5]]";
  given.sensor = "[sensor]\nadc_bits = 12\n";
  for (const double stiffness : {0.95, 0.98, 1.0, 1.02, 1.05}) {
    for (const double coefficient : {0.7, 1.0, 1.3}) {
      for (const double contact : {0.5, 1.0, 1.5}) {
        given.stiffness_error = stiffness;
        given.model_error =
            fmt::format("coefficient = {}\ncontact_stiffness = {}", coefficient, contact);
        for (const report::StepMetrics& step : run(given).steps) {
          ASSERT_TRUE(step.settling_time_s) << stiffness << ' ' << given.model_error;
          EXPECT_LE(*step.settling_time_s, 0.25e-3 + 1e-9) << stiffness << ' ' << given.model_error;
          EXPECT_LE(step.ripple, 0.002) << stiffness << ' ' << given.model_error;
        }
      }
    }
  }
}

/// A contact that shares in the spring, and so shifts the mode.
TEST_P(Feeling, SettlesWithAModeThatTheContactShifts) {
  for (const double share : {0.01, 0.03, 0.1}) {
    for (const double mode : {0.2163, 0.7, 1.2}) {
      Loop given = loop();
      given.mode_per_carrier = mode;
      given.contact_stiffness_N_per_m = share * stiffness_N_per_m(given);
      expect_prompt(given);
    }
  }
}

/// Without a pause to learn friction in, the ratio is as wrong as what is believed of it. The
/// vibration that goes with it tells so where the two are further apart than mismatch_warning, but not
/// how far.
TEST_P(Feeling, NamesAFrictionThatIsBelievedWrong) {
  for (const double coefficient : {0.6, 0.75, 1.0, 1.3, 1.6}) {
    Loop given = loop();
    given.vibration += "\ncalibration_s = 0";
    given.targets = "[[0.0, 0.5]]";
    given.duration_s = 8e-3;  // the larger the error, the later the ratio comes into its band
    given.model_error = fmt::format("coefficient = {}", coefficient);
    const report::StepMetrics step = run(given).steps.front();
    const bool right = coefficient == 1.0;
    EXPECT_EQ(step.limit, right ? control::Limit::none : control::Limit::mismatch) << coefficient;
    EXPECT_TRUE(step.limit_seen_by_controller) << coefficient;
    EXPECT_FALSE(step.mismatch) << coefficient;
  }
}

}  // namespace
}  // namespace sonoglide::damping_test
