#include "host_sim/scene_file/reader.hpp"
#include "host_sim/configure/read/experiment.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "scene_texts.hpp"

namespace sonoglide::scene_file::reader_test {
namespace {

TEST(ReaderTest, NameIsThatOfTheFile) {
  EXPECT_EQ(read_text(shortest_open_loop, "some/where/table_1.toml").name, "table_1");
}

TEST(ReaderTest, DefaultsOfOpenLoop) {
  const scene::Scene scene = read_text(shortest_open_loop, "s");
  EXPECT_EQ(scene.plant.damping_N_s_per_m, 0.0);
  EXPECT_EQ(scene.plant.initial_displacement_m, 0.0);
  EXPECT_EQ(scene.plant.initial_velocity_m_per_s, 0.0);
  EXPECT_DOUBLE_EQ(scene.friction.normal_force_N, 0.1962);
  EXPECT_EQ(scene.friction.initial_force_N, 0.0);
  EXPECT_EQ(scene.friction.sign_convention, scene::SignConvention::dissipative);
  EXPECT_FALSE(scene.drive.has_value());
  EXPECT_EQ(scene.solver.method, scene::method_of<scene::solvers::EventTaylor>);
  EXPECT_EQ(scene.solver.tolerance, 1e-10);
  EXPECT_EQ(scene.run.start, scene::Start::given);
  EXPECT_EQ(scene.run.window_start_s, 0.0);
  EXPECT_TRUE(scene.run.record.empty());
  EXPECT_EQ(scene.run.record_interval_s, 0.0);
  EXPECT_FALSE(scene.controller.has_value());
}

TEST(ReaderTest, FrictionProfiles) {
  const scene::Scene scene = read_text(profiles_open_loop, "s");
  ASSERT_EQ(scene.friction.coefficient_profile.size(), 4U);
  EXPECT_EQ(scene.friction.coefficient_profile[2].time_s, 1e-3);
  EXPECT_EQ(scene.friction.coefficient_profile[2].value, 0.2);
  ASSERT_EQ(scene.friction.normal_force_profile_N.size(), 1U);
  EXPECT_EQ(scene.friction.coefficient, 0.1) << "at 0 s";
  EXPECT_EQ(scene.friction.normal_force_N, 0.2) << "before the first row";
  EXPECT_EQ(scene.sensor.force_full_scale_N, 2.0 * (0.2 * 0.2)) << "of the largest";
  const scene::ContactValues late = configure::contact_at(scene.friction, 1.5e-3);
  EXPECT_NEAR(late.coefficient, 0.1, 1e-16);
  EXPECT_EQ(late.normal_force_N, 0.2);
}

TEST(TimedProfileTest, IsLinearBetweenRowsAndJumpsAtTwoOfOneTime) {
  const scene::TimedProfile profile = {{1.0, 2.0}, {3.0, 4.0}, {3.0, 10.0}, {5.0, 0.0}};
  EXPECT_EQ(scene::value_at(profile, 0.0), 2.0);
  EXPECT_EQ(scene::value_at(profile, 1.0), 2.0);
  EXPECT_EQ(scene::value_at(profile, 2.0), 3.0);
  EXPECT_EQ(scene::value_at(profile, 3.0), 10.0) << "after the jump";
  EXPECT_EQ(scene::value_at(profile, 4.0), 5.0);
  EXPECT_EQ(scene::value_at(profile, 9.0), 0.0);
  EXPECT_EQ(scene::smallest_value(profile), 0.0);
  EXPECT_EQ(scene::largest_value(profile), 10.0);
}

TEST(ReaderTest, EveryKeyOfOpenLoop) {
  const scene::Scene scene = read_text(fullest_open_loop, "s");
  EXPECT_EQ(scene.plant.mass_kg, 0.02);
  EXPECT_EQ(scene.plant.stiffness_N_per_m, 133e6);
  EXPECT_EQ(scene.plant.damping_N_s_per_m, 1.5);
  EXPECT_EQ(scene.plant.initial_displacement_m, -1e-7);
  EXPECT_EQ(scene.plant.initial_velocity_m_per_s, 2e-3);
  EXPECT_TRUE(scene::is<scene::laws::Dahl>(scene.friction.law));
  EXPECT_EQ(scene.friction.coefficient, 0.2);
  EXPECT_EQ(scene.friction.normal_force_N, 3.0) << "an integer where a real number is meant";
  EXPECT_EQ(scene.friction.contact_stiffness_N_per_m, 56e3);
  EXPECT_EQ(scene.friction.initial_force_N, -0.25);
  EXPECT_EQ(scene.friction.sign_convention, scene::SignConvention::as_printed);
  ASSERT_EQ(scene.sliding.profile.size(), 2U);
  EXPECT_EQ(scene.sliding.profile[1].time_s, 2e-3);
  EXPECT_EQ(scene.sliding.profile[1].velocity_m_per_s, -0.02);
  ASSERT_TRUE(scene.drive.has_value());
  EXPECT_EQ(scene.drive->frequency_Hz, 40e3);
  EXPECT_EQ(scene.drive->force_amplitude_N, 384.0);
  EXPECT_EQ(scene.drive->waveform, scene::Waveform::cosine);
  EXPECT_EQ(scene.solver.method, scene::method_of<scene::solvers::Rk4>);
  EXPECT_EQ(scene.solver.step_s, 1e-8);
  EXPECT_EQ(scene.run.duration_s, 2.5e-3) << "100 periods of 25 us";
  EXPECT_EQ(scene.run.window_start_s, 1.25e-3);
  EXPECT_EQ(scene.run.record, (std::vector<scene::Channel>{
                                  scene::Channel::sliding_velocity, scene::Channel::displacement,
                                  scene::Channel::velocity, scene::Channel::friction_force,
                                  scene::Channel::drive_force}));
  EXPECT_EQ(scene.run.record_interval_s, 1e-6);
}

TEST(ReaderTest, DefaultsOfClosedLoop) {
  const scene::Scene scene = read_text(shortest_closed_loop, "s");
  EXPECT_FALSE(scene.drive->max_force_slew_N_per_s.has_value());
  EXPECT_FALSE(scene.drive->bits.has_value());
  EXPECT_EQ(scene.drive->interpolation, scene::Interpolation::step);
  EXPECT_EQ(scene.drive->codes_per_period, 1);
  EXPECT_EQ(scene.drive->bias_limit_N, 0.0);
  EXPECT_EQ(scene.run.settling_band, 0.01);
  ASSERT_TRUE(scene.controller.has_value());
  EXPECT_EQ(experiment::read_text(shortest_closed_loop, "s").plant.controller->calibration_s, 0.0);
  EXPECT_EQ(scene.controller->shaping, scene::Shaping::notch);
  EXPECT_FALSE(scene.controller->speed_floor_m_per_s.has_value());
  EXPECT_FALSE(scene.sensor.adc_bits.has_value());
  EXPECT_DOUBLE_EQ(scene.sensor.force_full_scale_N, 0.03924) << "twice the friction limit";
  EXPECT_EQ(scene.sensor.force_noise_N, 0.0);
  EXPECT_FALSE(scene.sensor.force_bandwidth_Hz.has_value());
  EXPECT_FALSE(scene.sensor.samples_per_period.has_value());
  EXPECT_FALSE(scene.sensor.filter_Hz.has_value());
  EXPECT_FALSE(scene.sensor.velocity_bits.has_value());
  EXPECT_EQ(scene.sensor.delay_periods, 0);
  EXPECT_EQ(scene.sensor.force_offset_N, 0.0);
  EXPECT_EQ(scene.sensor.force_gain, 1.0);
  EXPECT_EQ(scene.sensor.velocity_offset_m_per_s, 0.0);
  EXPECT_EQ(scene.sensor.velocity_gain, 1.0);
  EXPECT_EQ(scene.sensor.seed, 1U);
  EXPECT_EQ(scene.model_error.mass, 1.0);
  EXPECT_EQ(scene.model_error.stiffness, 1.0);
  EXPECT_EQ(scene.model_error.coefficient, 1.0);
  EXPECT_EQ(scene.model_error.contact_stiffness, 1.0);
}

/// @param key  of [controller], a line or none
std::string sensorless(const std::string& sliding, const std::string& key) {
  return "[plant]\nmass_kg = 0.02\nstiffness_N_per_m = 133e6\n"
         "[friction]\nlaw = \"dahl\"\ncoefficient = 0.1\ncontact_stiffness_N_per_m = 0.056e6\n"
         "[sliding]\n" +
         sliding +
         "\n[drive]\nfrequency_Hz = 60e3\nmax_force_amplitude_N = 1920\n"
         "[run]\nduration_s = 4e-3\n"
         "[controller]\narithmetic = \"q31\"\ntarget_friction_ratio = [[0, 0.5]]\n"
         "vibration = \"damped\"\n" +
         key;
}

/// Where the vibration is felt in the friction, that is learnt first; 0 trusts the scene there too.
TEST(ReaderTest, DefaultOfCalibrationWhereTheFrictionShowsTheVibration) {
  const std::string steady = "velocity_m_per_s = 0.0267";
  const auto calibration_s = [](const std::string& text) {
    return *experiment::read_text(text, "s").plant.controller->calibration_s;
  };
  const scene::Scene absent = read_text(sensorless(steady, ""), "s");
  const double by_default_s =
      configure::shortest_calibration_s(absent, configure::design_control(absent));
  EXPECT_GT(by_default_s, 0.0);
  EXPECT_EQ(calibration_s(sensorless(steady, "")), by_default_s);
  EXPECT_EQ(calibration_s(sensorless(steady, "calibration_s = 0\n")), 0.0);
  EXPECT_EQ(calibration_s(sensorless(steady, "friction = \"trusted\"\n")), 0.0);
  EXPECT_EQ(calibration_s(sensorless(steady, "friction = \"calibrated\"\n")), by_default_s);
  // A sliding that begins at rest goes on for too short a time within half of that of the target, or
  // for long enough.
  const auto from_rest = [](const char* begins_s) {
    return sensorless("profile = [[0.0, 0.0], [" + std::string(begins_s) + ", 0.0267]]", "");
  };
  EXPECT_EQ(calibration_s(from_rest("3.9e-3")), 0.0);
  EXPECT_GT(calibration_s(from_rest("1e-4")), by_default_s);
  // The truth is not known to the controller.
  EXPECT_EQ(calibration_s(sensorless(steady, "[true_values]\n\"friction.coefficient\" = 0.2\n")),
            by_default_s);
}

TEST(ReaderTest, EveryKeyOfClosedLoop) {
  const scene::Scene scene = read_text(fullest_closed_loop, "s");
  EXPECT_EQ(scene.sliding.profile.front().velocity_m_per_s, -0.0267);
  EXPECT_EQ(scene.drive->max_force_amplitude_N, 1920.0);
  EXPECT_EQ(scene.drive->max_force_slew_N_per_s, 1e8);
  EXPECT_EQ(scene.drive->bits, 12);
  EXPECT_EQ(scene.drive->interpolation, scene::Interpolation::linear);
  EXPECT_EQ(scene.drive->codes_per_period, 4);
  EXPECT_EQ(scene.drive->bias_limit_N, 0.0);
  EXPECT_EQ(read_text(damped_closed_loop, "s").drive->bias_limit_N, 5.0);
  EXPECT_EQ(scene.solver.tolerance, 1e-12);
  EXPECT_EQ(scene.solver.order, 16);
  EXPECT_EQ(scene.run.duration_s, 4e-3);
  EXPECT_EQ(scene.run.window_start_s, 1e-3);
  EXPECT_EQ(scene.run.settling_band, 0.02);
  EXPECT_EQ(scene.controller->arithmetic, scene::Arithmetic::float32);
  EXPECT_EQ(scene.controller->every_periods, 2);
  ASSERT_EQ(scene.controller->target_friction_ratio.size(), 2U);
  EXPECT_EQ(scene.controller->target_friction_ratio[1].time_s, 2e-3);
  EXPECT_EQ(scene.controller->target_friction_ratio[1].value, 0.6);
  EXPECT_EQ(scene.controller->calibration_s, 0.5e-3);
  EXPECT_EQ(scene.controller->shaping, scene::Shaping::robust);
  EXPECT_EQ(scene.controller->shaping_range, 0.2);
  EXPECT_EQ(scene.controller->speed_floor_m_per_s, 1e-4);
  EXPECT_EQ(scene.sensor.adc_bits, 12);
  EXPECT_EQ(scene.sensor.force_full_scale_N, 0.04);
  EXPECT_EQ(scene.sensor.force_noise_N, 1e-4);
  EXPECT_EQ(scene.sensor.force_bandwidth_Hz, 5e3);
  EXPECT_EQ(scene.sensor.delay_periods, 2);
  EXPECT_EQ(scene.sensor.force_offset_N, -2e-3);
  EXPECT_EQ(scene.sensor.force_gain, 0.9);
  EXPECT_EQ(scene.sensor.velocity_offset_m_per_s, 1e-3);
  EXPECT_EQ(scene.sensor.velocity_gain, -1.0);
  EXPECT_EQ(scene.sensor.velocity_bits, 14);
  EXPECT_EQ(scene.sensor.seed, 9223372036854775807U);
  EXPECT_EQ(scene.model_error.mass, 0.9);
  EXPECT_EQ(scene.model_error.stiffness, 1.04);
  EXPECT_EQ(scene.model_error.coefficient, 1.3);
  EXPECT_EQ(scene.model_error.contact_stiffness, 1.5);
}

/// In place of force_bandwidth_Hz, which acts on the mean.
TEST(ReaderTest, AForceThatIsSampledWithinThePeriod) {
  const scene::Sensor sensor = read_text(shortest_closed_loop, "s",
                                         {"sensor.samples_per_period=16", "sensor.filter_Hz=60e3"})
                                   .sensor;
  EXPECT_EQ(sensor.samples_per_period, 16);
  EXPECT_EQ(sensor.filter_Hz, 60e3);
  EXPECT_EQ(sensor.low_pass_Hz(), 60e3);
}

TEST(ReaderTest, DeadAndReversedSensorsAreScenes) {
  for (const double gain : {0.0, -1.0, 100.0, -100.0}) {
    const std::string value = std::to_string(gain);
    const scene::Sensor sensor =
        read_text(shortest_closed_loop, "s",
                  {"sensor.force_gain=" + value, "sensor.velocity_gain=" + value})
            .sensor;
    EXPECT_EQ(sensor.force_gain, gain);
    EXPECT_EQ(sensor.velocity_gain, gain);
  }
}

TEST(ReaderTest, ZeroFrictionDriveAndDampingAreScenes) {
  EXPECT_EQ(read_text(shortest_open_loop, "s", {"friction.coefficient=0"}).friction.coefficient,
            0.0);
  EXPECT_EQ(
      read_text(shortest_open_loop, "s", {"friction.normal_force_N=0"}).friction.normal_force_N,
      0.0);
  EXPECT_EQ(
      read_text(fullest_open_loop, "s", {"drive.force_amplitude_N=0"}).drive->force_amplitude_N,
      0.0);
  EXPECT_EQ(
      read_text(fullest_open_loop, "s", {"plant.damping_N_s_per_m=0"}).plant.damping_N_s_per_m,
      0.0);
}

TEST(ReaderTest, OverridesTakeTomlAndBareWords) {
  EXPECT_EQ(read_text(shortest_closed_loop, "s", {"controller.arithmetic=float64"})
                .controller->arithmetic,
            scene::Arithmetic::float64);
  EXPECT_EQ(read_text(shortest_closed_loop, "s", {"controller.arithmetic=\"float64\""})
                .controller->arithmetic,
            scene::Arithmetic::float64);
  const scene::Scene scene = read_text(
      shortest_closed_loop, "s", {"controller.target_friction_ratio=[[0, 0.3], [1e-3, 0.5]]"});
  EXPECT_EQ(scene.controller->target_friction_ratio[1].value, 0.5);
}

TEST(ReaderTest, AnIntegerBeyondTheDigitsOfARealNumberIsRounded) {
  EXPECT_EQ(read_text(shortest_open_loop, "s", {"plant.stiffness_N_per_m=9007199254740993"})
                .plant.stiffness_N_per_m,
            9007199254740992.0);
}

TEST(ReaderTest, AnOverrideMakesTheTableItNeeds) {
  EXPECT_EQ(read_text(shortest_closed_loop, "s", {"sensor.adc_bits=10"}).sensor.adc_bits, 10);
}

TEST(ReaderTest, ManyOverridesStayWithTheirValues) {
  std::vector<std::string> overrides;
  for (int i = 1; i <= 1000; ++i) {
    overrides.push_back("plant.mass_kg=" + std::to_string(i));
    overrides.push_back("friction.coefficient=0.5");
  }
  const scene::Scene scene = read_text(shortest_open_loop, "s", overrides);
  EXPECT_EQ(scene.plant.mass_kg, 1000.0);
  EXPECT_EQ(scene.friction.coefficient, 0.5);
}

TEST(ReaderTest, AnEmptyListSwitchesTheRecordingOff) {
  const scene::Scene scene = read_text(fullest_open_loop, "s", {"run.record=[]"});
  EXPECT_TRUE(scene.run.record.empty());
  EXPECT_EQ(scene.run.record_interval_s, 0.0);
}

TEST(ReaderTest, DottedKeysAndInlineTablesAreTheSameScene) {
  const scene::Scene scene = read_text(
      "plant = {mass_kg = 1, stiffness_N_per_m = 2}\n"
      "friction.law = 'none'\n"
      "sliding.velocity_m_per_s = 0\n"
      "run.duration_s = 1\n",
      "s");
  EXPECT_EQ(scene.plant.stiffness_N_per_m, 2.0);
  EXPECT_TRUE(scene::is<scene::laws::None>(scene.friction.law));
}

std::string refused_key(std::vector<std::string> overrides) {
  overrides.emplace_back("run.start='steady'");
  try {
    read_text(shortest_open_loop, "s", overrides);
  } catch (const SceneError& error) {
    return error.key();
  }
  return {};
}

TEST(ReaderTest, ASteadyOrbitHasAPeriodAndNoOtherBeginning) {
  EXPECT_EQ(refused_key({}), "run.start") << "no drive";
  const std::string hertz = "drive.frequency_Hz=60e3";
  const std::string newton = "drive.force_amplitude_N=384";
  EXPECT_EQ(refused_key({hertz, newton}), "");
  EXPECT_EQ(refused_key({hertz, newton, "plant.initial_displacement_m=0"}),
            "plant.initial_displacement_m");
  EXPECT_EQ(refused_key({hertz, newton, "plant.initial_velocity_m_per_s=0"}),
            "plant.initial_velocity_m_per_s");
  EXPECT_EQ(refused_key({hertz, newton, "friction.initial_force_N=0"}), "friction.initial_force_N");
}

TEST(ReaderTest, ALoadTakesThePlaceOfTheSliding) {
  const scene::Scene scene = read_text(load_open_loop, "s");
  ASSERT_TRUE(scene.load.has_value());
  EXPECT_EQ(scene.load->mass_kg, 0.5);
  EXPECT_EQ(scene.load->damping_N_s_per_m, 0.2);
  EXPECT_EQ(scene.load->initial_velocity_m_per_s, 0.01);
  ASSERT_EQ(scene.load->force_profile_N.size(), 3U);
  EXPECT_EQ(scene.load->force_profile_N[2].value, -0.1);
  EXPECT_EQ(scene.load->spring_N_per_m, 2e3);
  ASSERT_EQ(scene.load->pull_profile_m_per_s.size(), 2U);
  // For a controller: 0.1 N over 0.2 N s/m is faster than the pull.
  EXPECT_EQ(scene.sliding.fastest_m_per_s(), 0.5);
  EXPECT_EQ(scene.solver.method, scene::method_of<scene::solvers::EventTaylor>);
}

TEST(ReaderTest, ATableThatHasLostItsKeysIsGone) {
  const std::vector<std::string> load = {"load.mass_kg=0.5", "load.initial_velocity_m_per_s=0.01"};
  std::vector<std::string> instead = {"sliding.velocity_m_per_s="};
  instead.insert(instead.end(), load.begin(), load.end());
  EXPECT_TRUE(read_text(shortest_open_loop, "s", instead).load.has_value());
  EXPECT_THROW(read_text(shortest_open_loop, "s", load), SceneError);
}

TEST(ReaderTest, TheErrorCarriesItsParts) {
  try {
    read_text("[plant]\n  mass_kg = -1\n", "dir/bad.toml");
    FAIL() << "no error";
  } catch (const SceneError& error) {
    EXPECT_EQ(error.file(), "dir/bad.toml");
    EXPECT_EQ(error.line(), 2U);
    EXPECT_EQ(error.column(), 13U);
    EXPECT_EQ(error.key(), "plant.mass_kg");
    EXPECT_EQ(error.message(), "-1 is out of range; allowed: 1e-12 to 1e+06 kg");
    EXPECT_STREQ(error.what(),
                 "dir/bad.toml:2:13: plant.mass_kg: -1 is out of range; allowed: 1e-12 to 1e+06 "
                 "kg");
  }
}

}  // namespace
}  // namespace sonoglide::scene_file::reader_test
