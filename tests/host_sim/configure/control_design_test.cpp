#include "host_sim/configure/control_design.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>
#include <utility>
#include <vector>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/nominal_plant.hpp"
#include "tests/common/constants/pi.hpp"
#include "tests/common/constants/table_1_numbers.hpp"
#include "tests/common/table_1.hpp"

namespace sonoglide::configure::control_design_test {
namespace {

using tests::carrier_Hz;
using tests::long_pi;
using tests::period_s;
using tests::pi;
using tests::table_1_closed_loop;
using tests::with_natural_frequency;

const double omega = 2.0 * pi * carrier_Hz;

/// The key that a refused scene should change.
std::string refused_key(const scene::Scene& scene) {
  try {
    design_control(scene);
  } catch (const ConfigurationError& error) {
    EXPECT_NE(std::string(error.what()).find("allowed:"), std::string::npos) << error.what();
    return error.key();
  }
  return "none";
}

/// The natural mode over one carrier period, exp((−σ ± iωd) T).
std::complex<long double> mode_of(const scene::Plant& plant) {
  const auto mass = static_cast<long double>(plant.mass_kg);
  const auto stiffness = static_cast<long double>(plant.stiffness_N_per_m);
  const auto damping = static_cast<long double>(plant.damping_N_s_per_m);
  const long double sigma = damping / (2.0L * mass);
  const long double damped = std::sqrt(stiffness / mass - sigma * sigma);
  return std::exp(std::complex<long double>(-sigma, damped) / 60e3L);
}

/// Magnitude of the shaper's transfer function.
double gain_at(const ControlDesign& design, std::complex<long double> z) {
  const std::complex<long double> back = std::pow(z, -static_cast<int>(design.notch()->spacing));
  return static_cast<double>(
      std::abs(static_cast<long double>(design.notch()->taps[0]) +
               back * (static_cast<long double>(design.notch()->taps[1]) +
                       back * static_cast<long double>(design.notch()->taps[2]))));
}

TEST(ControlDesignTest, NotchOfTable1IsTheTwoTapFormula) {
  const scene::Scene scene = table_1_closed_loop();
  const ControlDesign design = design_control(scene);
  const long double turn = std::sqrt(133e6L / 0.02L) / 60e3L;
  const long double sum = 2.0L - 2.0L * std::cos(turn);
  ASSERT_TRUE(design.notch());
  EXPECT_EQ(design.notch()->spacing, 1);
  EXPECT_NEAR(design.notch()->taps[0], static_cast<double>(1.0L / sum), 1e-15);
  EXPECT_NEAR(design.notch()->taps[1], static_cast<double>(-2.0L * std::cos(turn) / sum), 1e-15);
  EXPECT_NEAR(design.notch()->taps[2], static_cast<double>(1.0L / sum), 1e-15);
}

TEST(ControlDesignTest, NotchHasItsZerosOnTheNaturalModeAndUnitGain) {
  int shaped = 0;
  for (const double damping_ratio : {0.0, 0.01, 0.1, 0.5, 0.9}) {
    for (double part = 0.05; part < 3.0; part += 0.0173) {
      const scene::Scene scene = with_natural_frequency(part, damping_ratio);
      const ControlDesign design = design_control(scene);
      if (!design.notch()) {
        continue;
      }
      EXPECT_NEAR(gain_at(design, mode_of(scene.plant)), 0.0, 1e-11)
          << part << ' ' << damping_ratio;
      EXPECT_NEAR(gain_at(design, 1.0L), 1.0, 1e-14);
      ++shaped;
    }
  }
  EXPECT_GE(shaped, 150) << "most modes without damping";
}

TEST(ControlDesignTest, NotchSpacingIsTheSmallestThatKeepsEveryTapBelowOne) {
  int shaped = 0;
  for (double part = 0.0101; part < 3.0; part += 0.0107) {
    const ControlDesign design = design_control(with_natural_frequency(part));
    int smallest = 0;
    for (int spacing = 1; spacing <= max_notch_spacing && smallest == 0; ++spacing) {
      const long double cosine =
          std::cos(2.0L * long_pi * static_cast<long double>(part) * spacing);
      const long double sum = 2.0L - 2.0L * cosine;
      smallest = sum > 1.0L && std::abs(2.0L * cosine) < sum ? spacing : 0;
    }
    EXPECT_EQ(design.notch() != nullptr ? design.notch()->spacing : 0, smallest) << part;
    shaped += smallest > 0 ? 1 : 0;
  }
  EXPECT_GT(shaped, 250);
}

TEST(ControlDesignTest, NothingIsShapedWithoutANaturalMode) {
  const scene::Scene overdamped = with_natural_frequency(0.2, 1.5);
  EXPECT_FALSE(design_control(overdamped).notch());
  scene::Scene springless = table_1_closed_loop();
  springless.plant.stiffness_N_per_m = 0.0;
  EXPECT_FALSE(design_control(springless).notch());
  // With no shaper in the way the loop may be faster than with one.
  EXPECT_GT(design_control(springless).integral_gain,
            design_control(table_1_closed_loop()).integral_gain);
}

TEST(ControlDesignTest, NothingIsShapedWhereTheSceneSaysSo) {
  scene::Scene scene = table_1_closed_loop();
  scene.controller->shaping = scene::Shaping::none;
  EXPECT_FALSE(design_control(scene).notch());
  EXPECT_LT(design_control(scene).integral_gain, 0.01);
}

/// A plant with a notch for a natural frequency within this range.
scene::Scene robust(double range, double part) {
  scene::Scene scene = with_natural_frequency(part, 0.002);
  scene.controller->shaping = scene::Shaping::robust;
  scene.controller->shaping_range = range;
  return scene;
}

TEST(ControlDesignTest, ARobustNotchTakesItsSpanIntoTheDelays) {
  scene::Scene scene = table_1_closed_loop();
  const ControlDesign known = design_control(scene);
  scene.controller->shaping = scene::Shaping::robust;
  const ControlDesign design = design_control(scene);
  ASSERT_TRUE(design.notch());
  EXPECT_EQ(design.in_mode<FeedforwardDesign>()->shaping_range, 0.1);
  EXPECT_EQ(design.notch()->tap_count, 5U);
  EXPECT_EQ(design.notch_span(), 4);
  EXPECT_EQ(design.reference_delay_periods, known.reference_delay_periods + 1);
  EXPECT_EQ(design.lead_periods, known.lead_periods + 1.0);
  EXPECT_GT(design.hold_periods, known.hold_periods);
  EXPECT_NEAR(design.integral_gain, 2.0 / 3.0 * std::sin(pi / (4.0 * (4.0 + 2.0) + 2.0)), 1e-12);
}

TEST(ControlDesignTest, NotesAModeThatFeedbackMayBuildUp) {
  EXPECT_TRUE(design_notes(design_control(robust(0.1, 0.2163))).empty());
  scene::Scene scene = table_1_closed_loop();
  EXPECT_TRUE(design_notes(design_control(scene)).empty());
  scene.controller->shaping = scene::Shaping::robust;
  const ControlDesign undamped = design_control(scene);
  ASSERT_EQ(design_notes(undamped).size(), 1U);
  const std::string note = design_notes(undamped)[0];
  const std::size_t key = note.find("A plant.damping_N_s_per_m of ");
  ASSERT_NE(key, std::string::npos) << note;
  const double told = std::stod(note.substr(note.find(" of ", key) + 4));
  EXPECT_NEAR(told / (2.0 * std::sqrt(scene.plant.stiffness_N_per_m * scene.plant.mass_kg)), 2.1e-4,
              1e-5);
  scene.plant.damping_N_s_per_m = told;
  EXPECT_TRUE(design_notes(design_control(scene)).empty());
  scene.plant.damping_N_s_per_m = 0.98 * told;
  EXPECT_EQ(design_notes(design_control(scene)).size(), 1U);
}

// Slow sliding takes a weak drive, whose vibration a friction slows that is light beside the largest.
TEST(ControlDesignTest, TellsNoMismatchWhereFrictionSlowsAVibration) {
  scene::Scene scene = table_1_closed_loop();
  scene.friction.law = scene::laws::Coulomb{};
  scene.friction.contact_stiffness_N_per_m = 0.0;
  EXPECT_GT(design_control(scene).agreement, 0.0);
  scene.friction.normal_force_N = 30.0 / scene.friction.coefficient;
  scene.sensor.force_full_scale_N = 60.0;
  scene.sliding.profile = {{0.0, 0.002}};
  const ControlDesign slow = design_control(scene);
  EXPECT_TRUE(slow.maps_friction);
  EXPECT_FALSE(slow.estimates_mismatch);
  EXPECT_EQ(slow.agreement, 0.0);
}

TEST(ControlDesignTest, NotesWhatItMayFailToFeel) {
  const auto feeling = [](double frequency) {
    scene::Scene scene = with_natural_frequency(frequency);
    scene.controller->vibration = scene::VibrationControl::damped;
    scene.controller->calibration_s = shortest_calibration_s(scene, design_control(scene));
    return scene;
  };
  EXPECT_TRUE(design_notes(design_control(feeling(0.2163))).empty());
  scene::Scene trusting = feeling(0.2163);
  trusting.controller->calibration_s = 0.0;
  ASSERT_EQ(design_notes(design_control(trusting)).size(), 1U);
  EXPECT_NE(design_notes(design_control(trusting))[0].find(
                "The controller takes the friction force of the scene "),
            std::string::npos);
  const std::vector<std::string> next_to_a_multiple = design_notes(design_control(feeling(2.001)));
  ASSERT_EQ(next_to_a_multiple.size(), 1U);
  EXPECT_NE(next_to_a_multiple[0].find("no reading separates it from the driven vibration"),
            std::string::npos);
  EXPECT_EQ(design_control(feeling(2.001)).agreement, 0.0);
  EXPECT_GT(design_control(feeling(0.2163)).agreement, 0.0);
  EXPECT_TRUE(design_notes(design_control(feeling(1.8))).empty());
  using Told = std::pair<double, const char*>;
  for (const auto& [frequency, told] :
       {Told{1.02, "only where the stiffness is within 2.6 %"},
        Told{3.3,
             "off by more than 2.9 % may keep the friction ratio from settling: the natural mode "
             "then has a phase error"},
        Told{5.2, "off by more than 1.8 % may"},
        Told{2.93,
             "off by more than 0.68 % may keep the friction ratio from settling: the natural "
             "mode may then be within 0.06"},
        Told{2.03, "the friction ratio may swing about its target or stay off it"}}) {
    const std::vector<std::string> notes = design_notes(design_control(feeling(frequency)));
    ASSERT_EQ(notes.size(), frequency == 1.02 ? 2U : 1U) << frequency;
    EXPECT_NE(notes.back().find(told), std::string::npos) << notes.back();
  }
  scene::Scene slow = feeling(0.2163);
  slow.controller->calibration_s = 20e-3;
  slow.controller->target_friction_ratio = {{0.0, 0.4}};
  slow.sensor.force_bandwidth_Hz = 2000.0;
  EXPECT_TRUE(design_notes(design_control(slow)).empty());
  slow.sensor.force_bandwidth_Hz = 100.0;
  scene::Scene noisy = feeling(0.2163);
  noisy.sensor.force_noise_N = 0.05 * nominal_plant(noisy).friction_N;
  for (const scene::Scene& scene : {slow, noisy}) {
    const std::vector<std::string> notes = design_notes(design_control(scene));
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes.front().find("shows little of the natural mode"), std::string::npos);
  }
}

TEST(ControlDesignTest, NotesWhatARobustNotchCannotDo) {
  const ControlDesign none = design_control(robust(0.1, 1.05));
  EXPECT_FALSE(none.notch());
  ASSERT_EQ(design_notes(none).size(), 2U);
  EXPECT_NE(design_notes(none)[1].find("off by 10 %"), std::string::npos);
  const ControlDesign wide = design_control(robust(0.48, 0.2163));
  ASSERT_EQ(design_notes(wide).size(), 1U);
  EXPECT_NE(design_notes(wide)[0].find("off by up to 48 %"), std::string::npos);
  const ControlDesign slow = design_control(robust(0.05, 0.03));
  ASSERT_EQ(design_notes(slow).size(), 1U);
  EXPECT_NE(design_notes(slow)[0].find("spans"), std::string::npos);
}

TEST(ControlDesignTest, IntegralIsSlowerTheLongerTheSensorTakes) {
  double faster = 1.0;
  for (const int delay : {0, 1, 2, 4, 8, 64}) {
    scene::Scene scene = table_1_closed_loop();
    scene.sensor.delay_periods = delay;
    const ControlDesign design = design_control(scene);
    EXPECT_LT(design.integral_gain, faster);
    EXPECT_GT(design.integral_gain, 0.0);
    EXPECT_GE(design.hold_periods, 4 + delay);
    EXPECT_GT(design.stuck_periods, 4 + delay);
    // An integrator behind D periods of delay oscillates at this gain.
    const double critical = 2.0 * std::sin(pi / (4.0 * (4.0 + delay) + 2.0));
    EXPECT_NEAR(design.integral_gain, critical / 3.0, 1e-12);
    faster = design.integral_gain;
  }
}

/// Table 1, its vibration observed, with a contact that slides through its presliding distance in so many carrier
/// periods.
scene::Scene with_presliding_periods(double periods) {
  scene::Scene scene = table_1_closed_loop();
  scene.friction.contact_stiffness_N_per_m =
      tests::Table1::friction_limit_N / (periods * period_s * scene.sliding.fastest_m_per_s());
  scene.controller->vibration = scene::VibrationControl::damped;
  scene.sensor.vibration = scene::VibrationSensor::velocity;
  return scene;
}

TEST(ControlDesignTest, LeadsASlowContactByThePartThatCancelsItsLag) {
  const ControlDesign prompt = design_control(with_presliding_periods(4.0));
  EXPECT_EQ(prompt.contact_lead, 0.0);
  for (const double periods : {5.0, 8.0, 40.0}) {
    const ControlDesign slow = design_control(with_presliding_periods(periods));
    EXPECT_EQ(slow.integral_gain, prompt.integral_gain);
    EXPECT_NEAR(slow.contact_lead, slow.integral_gain * periods, 1e-9 * periods);
    // The error decays by the gain per period: the reference and the hold expect it.
    const double lag = 1.0 / slow.integral_gain;
    EXPECT_NEAR(slow.reference_keep, (lag + 1.0) / (lag + 2.0), 1e-12);
    EXPECT_EQ(slow.hold_periods, std::ceil(prompt.hold_periods + 4.0 * lag));
  }
  EXPECT_EQ(design_control(with_presliding_periods(1e9)).contact_lead, 1024.0);
  EXPECT_TRUE(design_notes(prompt).empty());
  const std::vector<std::string> notes = design_notes(design_control(with_presliding_periods(8.0)));
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("slides through its presliding distance"), std::string::npos);
}

TEST(ControlDesignTest, NotesACalibrationThatOutlastsTheFirstTarget) {
  scene::Scene scene = table_1_closed_loop();
  scene.controller->calibration_s = 1e-3;
  scene.controller->target_friction_ratio = {{0.0, 0.4}, {1.1e-3, 0.6}};
  EXPECT_TRUE(design_notes(design_control(scene)).empty());
  scene.controller->target_friction_ratio[1].time_s = 0.9e-3;
  const std::vector<std::string> notes = design_notes(design_control(scene));
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("lasts longer than the first target"), std::string::npos);
}

TEST(ControlDesignTest, LeadsASlowContactWithoutAVibrationSensor) {
  scene::Scene felt = with_presliding_periods(20.0);
  felt.sensor.vibration.reset();
  const ControlDesign design = design_control(felt);
  EXPECT_GT(design.contact_lead, 1.0);
  EXPECT_EQ(design.integral_gain, 0.0);
}

TEST(ControlDesignTest, LeadsNoContactThatIsPromptNorADriveThatIsFedForward) {
  scene::Scene stiff = with_presliding_periods(20.0);
  stiff.friction.law = scene::laws::Coulomb{};
  stiff.friction.contact_stiffness_N_per_m = 0.0;
  scene::Scene unsensed = with_presliding_periods(20.0);
  unsensed.sensor.force = false;
  scene::Scene fed_forward = with_presliding_periods(20.0);
  fed_forward.controller->vibration.reset();
  fed_forward.sensor.vibration.reset();
  for (const scene::Scene& scene : {stiff, unsensed, fed_forward}) {
    EXPECT_EQ(design_control(scene).contact_lead, 0.0);
  }
}

/// Fed forward, under a drive that ramps; the mode at 2.01 carrier frequencies.
scene::Scene slow_beside_a_multiple(double presliding_periods) {
  scene::Scene scene = with_presliding_periods(presliding_periods);
  scene.controller->vibration.reset();
  scene.sensor.vibration.reset();
  scene.controller->shaping.reset();
  scene.drive->interpolation = scene::Interpolation::linear;
  scene.drive->max_force_amplitude_N = 6000.0;
  const double natural_rad_per_s = 2.01 * 2.0 * pi * scene.drive->frequency_Hz;
  scene.plant.stiffness_N_per_m = scene.plant.mass_kg * natural_rad_per_s * natural_rad_per_s;
  return scene;
}

TEST(ControlDesignTest, ForeseesASlowContactBehindADriveThatIsFedForward) {
  EXPECT_FALSE(design_control(slow_beside_a_multiple(4.0)).contact_foresight);
  const scene::Scene scene = slow_beside_a_multiple(20.0);
  const ControlDesign design = design_control(scene);
  ASSERT_TRUE(design.contact_foresight);
  EXPECT_NEAR(design.contact_foresight->presliding_periods, 20.0, 1e-9);
  // Sliding over mean speed at full drive, by sums over a period.
  const double sliding = scene.sliding.fastest_m_per_s();
  double speed = 0.0;
  constexpr int phases = 10000;
  for (int i = 0; i < phases; ++i) {
    speed += std::abs(sliding + design.scales.velocity_m_per_s * std::cos(2.0 * pi * i / phases));
  }
  EXPECT_NEAR(design.contact_foresight->least_ratio, std::max(0.125, sliding * phases / speed),
              1e-5);
  const std::vector<std::string> notes = design_notes(design);
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
    return note.find("slides through its presliding distance") != std::string::npos;
  }));
}

TEST(ControlDesignTest, ForeseesNoContactBehindANotchThatTakesBackNorInFrontOfAFreeMode) {
  scene::Scene notched = slow_beside_a_multiple(20.0);
  notched.drive->interpolation = scene::Interpolation::step;
  const double natural_rad_per_s = 0.8 * 2.0 * pi * notched.drive->frequency_Hz;
  notched.plant.stiffness_N_per_m = notched.plant.mass_kg * natural_rad_per_s * natural_rad_per_s;
  scene::Scene averaged = notched;
  averaged.plant.stiffness_N_per_m *= 0.25;  // a quarter of a turn a period: taps of 1/2, 0, 1/2
  scene::Scene free = notched;
  free.controller->shaping = scene::Shaping::none;
  EXPECT_FALSE(design_control(notched).contact_foresight);
  EXPECT_FALSE(design_control(free).contact_foresight);
  EXPECT_TRUE(design_control(averaged).contact_foresight);
  EXPECT_FALSE(design_control(with_presliding_periods(20.0)).contact_foresight);
}

TEST(ControlDesignTest, ForeseesNoContactOfAForce) {
  scene::Scene scene = slow_beside_a_multiple(20.0);
  scene.controller->target_friction_ratio.clear();
  scene.controller->target_friction_force_N = {{0.0, 0.5 * nominal_plant(scene).friction_N}};
  EXPECT_FALSE(design_control(scene).contact_foresight);
}

/// Steps until a reading is that of a carrier period in which an answer acts, counted one by one.
int steps_to_the_reading(int every, int drive_delay, int sensor_delay) {
  const int first_driven =
      every + drive_delay;  // of the step at the end of carrier period every - 1
  int steps = 1;
  while ((steps + 1) * every - 1 - sensor_delay < first_driven) {
    ++steps;
  }
  return steps;
}

TEST(ControlDesignTest, WaitsForAReadingAsManyStepsAsItTakes) {
  scene::Scene scene = table_1_closed_loop();
  scene.controller->shaping = scene::Shaping::none;
  for (int every = 1; every <= 16; ++every) {
    for (const int drive_delay : {0, 1, 2, 3, 15, 16}) {
      for (const int sensor_delay : {0, 1, 7, 64}) {
        scene.controller->every_periods = every;
        scene.drive->delay_periods = drive_delay;
        scene.sensor.delay_periods = sensor_delay;
        EXPECT_EQ(design_control(scene).reference_delay_periods,
                  steps_to_the_reading(every, drive_delay, sensor_delay))
            << every << ' ' << drive_delay << ' ' << sensor_delay;
      }
    }
  }
}

TEST(ControlDesignTest, AStepOfSeveralPeriodsHasItsNotchOnTheModeOverAll) {
  scene::Scene scene = table_1_closed_loop();
  int notches = 0;
  for (int every = 1; every <= 16; ++every) {
    scene.controller->every_periods = every;
    const ControlDesign design = design_control(scene);
    if (design.notch() != nullptr) {
      EXPECT_LT(gain_at(design, std::pow(mode_of(scene.plant), every)), 1e-9) << every;
      ++notches;
    }
    EXPECT_EQ(design.notch() == nullptr, design.in_mode<FeedforwardDesign>()->free_mode) << every;
  }
  EXPECT_GE(notches, 14);
}

TEST(ControlDesignTest, TimesAreAsManyStepsAsFitIn) {
  scene::Scene scene = table_1_closed_loop();
  scene.controller->every_periods = 8;
  scene.controller->standstill_hold_s = 800.0 * period_s;
  scene.controller->calibration_s = 400.0 * period_s;
  scene.controller->target_friction_ratio = {{0.0, 0.4}};
  const ControlDesign design = design_control(scene);
  EXPECT_EQ(design.standstill_hold_periods, 100U);
  EXPECT_DOUBLE_EQ(design.standstill_fall, 8.0 / 128.0);
  EXPECT_EQ(design.calibration_total_periods, 49U);
  ASSERT_EQ(design_notes(design).size(), 1U);
  EXPECT_NE(design_notes(design)[0].find("once in 8 carrier periods"), std::string::npos);
}

TEST(ControlDesignTest, UndampedResonanceHasNoController) {
  scene::Scene scene = table_1_closed_loop();
  scene.plant.stiffness_N_per_m = scene.plant.mass_kg * omega * omega;
  EXPECT_EQ(refused_key(scene), "drive.frequency_Hz");
  scene.plant.stiffness_N_per_m *= 1.0 + 1e-12;
  EXPECT_EQ(refused_key(scene), "drive.frequency_Hz");
  scene.plant.damping_N_s_per_m = 10.0;  // amplifies 750 times
  EXPECT_EQ(refused_key(scene), "none");
}

TEST(ControlDesignTest, BaseOfSpeedIsThePeakVibrationAtFullDrive) {
  const scene::Scene scene = table_1_closed_loop();
  const ControlDesign design = design_control(scene);
  EXPECT_NEAR(design.scales.velocity_m_per_s, 0.267147944395619, 1e-12);
  EXPECT_DOUBLE_EQ(design.scales.carrier_period_s, period_s);
  EXPECT_EQ(design.scales.drive_amplitude_N, 1920.0);
  EXPECT_EQ(design.scales.force_N, scene.sensor.force_full_scale_N);
  EXPECT_DOUBLE_EQ(design.friction_force, 0.5);
}

TEST(ControlDesignTest, ModelErrorIsWhatIsBelievedOverWhatIsTrue) {
  scene::Scene scene = table_1_closed_loop();
  const ControlDesign exact = design_control(scene);
  scene.model_error.coefficient = 1.3;
  scene.model_error.contact_stiffness = 1.5;
  const ControlDesign contact = design_control(scene);
  EXPECT_DOUBLE_EQ(contact.friction_force, 1.3 * exact.friction_force);
  EXPECT_DOUBLE_EQ(contact.contact_force, 1.5 * exact.contact_force);
  EXPECT_EQ(contact.notch()->taps, exact.notch()->taps);

  scene = table_1_closed_loop();
  scene.model_error.stiffness = 1.04;
  scene::Scene stiffer = table_1_closed_loop();
  stiffer.plant.stiffness_N_per_m *= 1.04;
  EXPECT_EQ(design_control(scene).notch()->taps, design_control(stiffer).notch()->taps);
  scene = table_1_closed_loop();
  scene.model_error.mass = 0.9;
  scene::Scene lighter = table_1_closed_loop();
  lighter.plant.mass_kg *= 0.9;
  EXPECT_EQ(design_control(scene).notch()->taps, design_control(lighter).notch()->taps);
  EXPECT_EQ(design_control(scene).scales.velocity_m_per_s,
            design_control(lighter).scales.velocity_m_per_s);
}

TEST(ControlDesignTest, SpeedFloorIsThreePeriodsOfPreslidingTravel) {
  const scene::Scene scene = table_1_closed_loop();
  const ControlDesign design = design_control(scene);
  const double floor_m_per_s = design.speed_floor * design.scales.velocity_m_per_s;
  EXPECT_NEAR(
      floor_m_per_s,
      tests::Table1::friction_limit_N / tests::Table1::contact_stiffness_N_per_m / (3.0 * period_s),
      1e-12);
}

TEST(ControlDesignTest, SpeedFloorOfAStiffContactIsATenThousandthOfTheVibration) {
  scene::Scene scene = table_1_closed_loop();
  scene.friction.contact_stiffness_N_per_m = 1e9;
  EXPECT_DOUBLE_EQ(design_control(scene).speed_floor, 1e-4);
}

TEST(ControlDesignTest, SpeedFloorIsAtMostHalfTheFastestSliding) {
  scene::Scene scene = table_1_closed_loop();
  scene.friction.contact_stiffness_N_per_m = 0.056e4;
  const ControlDesign design = design_control(scene);
  EXPECT_NEAR(design.speed_floor * design.scales.velocity_m_per_s,
              0.5 * scene.sliding.profile.front().velocity_m_per_s, 1e-12);
}

TEST(ControlDesignTest, CalibrationCoversPreslidingAndTheSensor) {
  scene::Scene scene = table_1_closed_loop();
  scene.sensor.force_bandwidth_Hz = 500.0;  // a time constant of 19 carrier periods
  scene.controller->calibration_s = 1e-3;
  EXPECT_EQ(refused_key(scene), "controller.calibration_s");
  scene.controller->calibration_s = 4e-3;
  EXPECT_GE(design_control(scene).calibration_settle_periods, 96U);
}

TEST(ControlDesignTest, SpeedFloorMayBeStated) {
  scene::Scene scene = table_1_closed_loop();
  scene.controller->speed_floor_m_per_s = 0.01;
  const ControlDesign design = design_control(scene);
  EXPECT_NEAR(design.speed_floor * design.scales.velocity_m_per_s, 0.01, 1e-15);
  scene.controller->speed_floor_m_per_s = 0.3;
  EXPECT_EQ(refused_key(scene), "controller.speed_floor_m_per_s");
  scene.controller->speed_floor_m_per_s = 1e-5;
  EXPECT_EQ(refused_key(scene), "controller.speed_floor_m_per_s");
}

TEST(ControlDesignTest, FrictionOutsideTheSensorsScaleIsRefused) {
  scene::Scene scene = table_1_closed_loop();
  for (const double full_scale_N : {0.018, 25.0}) {
    scene.sensor.force_full_scale_N = full_scale_N;
    EXPECT_EQ(refused_key(scene), "sensor.force_full_scale_N") << full_scale_N;
  }
  for (const double full_scale_N : {0.0197, 0.04, 15.0}) {
    scene.sensor.force_full_scale_N = full_scale_N;
    EXPECT_EQ(refused_key(scene), "none") << full_scale_N;
  }
}

TEST(ControlDesignTest, SlewIsSharedAmongTheTaps) {
  scene::Scene scene = table_1_closed_loop();
  scene.drive->max_force_slew_N_per_s = 5e6;
  const ControlDesign design = design_control(scene);
  double gain = 0.0;
  for (const double tap : design.notch()->taps) {
    gain += std::abs(tap);
  }
  ASSERT_TRUE(design.slew_limited);
  EXPECT_NEAR(design.slew_per_period * gain, 5e6 * period_s / 1920.0, 1e-15);
}

TEST(ControlDesignTest, SlewThatNothingReachesIsNoLimit) {
  scene::Scene scene = table_1_closed_loop();
  scene.drive->max_force_slew_N_per_s = 1e9;
  EXPECT_FALSE(design_control(scene).slew_limited);
  scene.controller->shaping = scene::Shaping::none;
  scene.drive->max_force_slew_N_per_s = 1.01 * 1920.0 * carrier_Hz;
  EXPECT_FALSE(design_control(scene).slew_limited);
  scene.drive->max_force_slew_N_per_s = 0.99 * 1920.0 * carrier_Hz;
  EXPECT_TRUE(design_control(scene).slew_limited);
  EXPECT_NEAR(design_control(scene).slew_per_period, 0.99, 1e-12);
}

TEST(ControlDesignTest, CalibrationIsCountedInCarrierPeriods) {
  scene::Scene scene = table_1_closed_loop();
  EXPECT_FALSE(design_control(scene).calibrated);
  scene.controller->calibration_s = 0.5e-3;
  const ControlDesign design = design_control(scene);
  ASSERT_TRUE(design.calibrated);
  // The drive begins in the period after the last sample.
  EXPECT_EQ(design.calibration_total_periods, 29U);
  EXPECT_EQ(design.calibration_settle_periods + design.calibration_average_periods, 29U);
  EXPECT_GT(design.calibration_average_periods, 0U);
}

TEST(ControlDesignTest, TheShortestCalibrationIsForAContactHalfAsStiff) {
  scene::Scene scene = table_1_closed_loop();
  const auto periods = [&] {
    return std::round(shortest_calibration_s(scene, design_control(scene)) * carrier_Hz);
  };
  // 14 travels of 0.350 um at 0.445 um in a period, and one reading.
  EXPECT_EQ(periods(), 12.0 + 1.0 + 2.0);
  scene.sensor.force_noise_N = 0.01 * 0.01962;
  EXPECT_EQ(periods(), 12.0 + 16.0 + 2.0);
  scene.controller->calibration_s = shortest_calibration_s(scene, design_control(scene));
  EXPECT_TRUE(design_control(scene).calibrated);
  // Of many readings noise alone sets some far apart.
  EXPECT_NEAR(design_control(scene).calibration_half_steady, 0.5 * (0.4 * 0.5 + 10.0 * 0.005),
              1e-9);
  scene.controller->calibration_s = 1e-3;
  EXPECT_EQ(design_control(scene).calibration_half_steady, 1.0);
  // At most half of the first target's time; not where that is less than 7 travels take.
  scene.sensor.force_noise_N = 0.0;
  scene.controller->target_friction_ratio = {{0.0, 0.4}, {20.0 / carrier_Hz, 0.6}};
  EXPECT_EQ(periods(), 10.0);
  scene.controller->calibration_s = shortest_calibration_s(scene, design_control(scene));
  EXPECT_TRUE(design_control(scene).calibrated);
  scene.controller->target_friction_ratio = {{0.0, 0.4}, {16.0 / carrier_Hz, 0.6}};
  EXPECT_EQ(periods(), 0.0);
}

scene::Scene damped(double part) {
  scene::Scene scene = with_natural_frequency(part);
  scene.controller->vibration = scene::VibrationControl::damped;
  scene.sensor.vibration = scene::VibrationSensor::velocity;
  return scene;
}

TEST(ControlDesignTest, ADampedModeIsLookedForWhereItMayBe) {
  for (const double part : {0.3, 0.7, 1.08, 2.4, 5.0}) {
    const ControlDesign design = design_control(damped(part));
    ASSERT_TRUE(design.in_mode<DampedDesign>());
    const double range = design.in_mode<DampedDesign>()->stiffness_range;
    EXPECT_GT(range, 0.0);
    EXPECT_LE(range, 0.06);
    // The carrier stays outside.
    EXPECT_LE(range, 0.67 * std::abs(1.0 - 1.0 / (part * part))) << part;
    EXPECT_LE(0.5 * range * 2.0 * pi * part, 0.7201) << part;
    const auto& rows = design.in_mode<DampedDesign>()->table;
    for (const auto& row : rows) {
      EXPECT_NEAR(std::hypot(row[control::mode::rotation], row[control::mode::rotation + 1]), 1.0,
                  1e-12);
    }
    const double angle = 2.0 * pi * part * std::sqrt(1.0 - range);
    EXPECT_NEAR(rows.front()[control::mode::rotation], std::cos(angle), 1e-12) << part;
  }
}

TEST(ControlDesignTest, AFeltModeNeedsALongitudinalVibrationAndOneDirection) {
  scene::Scene sensorless = with_natural_frequency(0.2, 0.0);
  sensorless.controller->vibration = scene::VibrationControl::damped;
  const ControlDesign design = design_control(sensorless);
  ASSERT_TRUE(design.in_mode<SensorlessDesign>());
  EXPECT_FALSE(design.notch());
  EXPECT_FALSE(design.in_mode<DampedDesign>());
  scene::Scene turning = sensorless;
  turning.sliding.profile = {{0.0, 0.02}, {1.0, -0.02}};
  EXPECT_THROW(design_control(turning), ConfigurationError);
  scene::Scene across = sensorless;
  across.friction.law = scene::laws::TransverseCoulomb{};
  EXPECT_THROW(design_control(across), ConfigurationError);
}

TEST(ControlDesignTest, NotesADampedModeThatNothingQuietsQuickly) {
  for (const double part : {0.03, 0.96, 1.03, 1.97, 3.0}) {
    EXPECT_EQ(design_notes(design_control(damped(part))).size(), 1U) << part;
  }
  for (const double part : {0.2163, 0.9, 1.1, 2.5}) {
    EXPECT_TRUE(design_notes(design_control(damped(part))).empty()) << part;
  }
}

}  // namespace
}  // namespace sonoglide::configure::control_design_test
