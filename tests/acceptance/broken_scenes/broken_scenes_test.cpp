#include <gtest/gtest.h>

#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "base_scenes.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::broken_scenes_test {
namespace {

/// A good scene, the text to replace in it, what stands there instead, and all of stderr after the
/// file's name.
struct BrokenScene {
  const char* name;
  std::string base;
  const char* old_text;
  const char* new_text;
  const char* error;
};

void PrintTo(const BrokenScene& scene, std::ostream* out) {
  *out << scene.name;
}

std::string edited(const BrokenScene& scene) {
  std::string text = scene.base;
  const std::string old_text = scene.old_text;
  const std::size_t at = text.find(old_text);
  if (at == std::string::npos) {
    throw std::logic_error("the edit does not apply");
  }
  return text.replace(at, old_text.size(), scene.new_text);
}

const std::vector<BrokenScene> broken_scenes = {
    // No controller can be designed
    {"undamped_resonance", closed_loop, "frequency_Hz = 60e3", "frequency_Hz = 13235.7",
     "11:16: drive.frequency_Hz: is the plant's natural frequency, and with so little damping the "
     "vibration never settles; allowed: another frequency, more plant.damping_N_s_per_m, or with "
     "a [transducer] controller.vibration = \"resonant\""},
    {"full_scale_far_above_friction", closed_loop, "adc_bits = 12",
     "adc_bits = 12\nforce_full_scale_N = 100",
     "20:22: sensor.force_full_scale_N: is 100 N, of which the nominal friction force of 0.01962 "
     "N "
     "makes 0.000196; "
     "allowed: above 0.0196201, at most 20.0908 N"},
    {"full_scale_below_friction", closed_loop, "adc_bits = 12",
     "adc_bits = 12\nforce_full_scale_N = 0.01",
     "20:22: sensor.force_full_scale_N: is 0.01 N, of which the nominal friction force of 0.01962 "
     "N "
     "makes 1.96; "
     "allowed: above 0.0196201, at most 20.0908 N"},
    {"speed_floor_too_high", closed_loop, "arithmetic = \"float32\"",
     "arithmetic = \"float32\"\nspeed_floor_m_per_s = 0.5",
     "17:23: controller.speed_floor_m_per_s: is 1.87 of the peak vibration velocity at full drive; "
     "allowed: 2.67674e-05 to below 0.267673 m/s"},
    {"converter_too_coarse", closed_loop, "adc_bits = 12", "adc_bits = 8\nforce_full_scale_N = 2",
     "19:12: sensor.adc_bits: one code is 0.796 of the nominal friction force; allowed: at least "
     "11 bits, or a smaller sensor.force_full_scale_N"},
    {"calibration_too_short", closed_loop, "arithmetic = \"float32\"",
     "arithmetic = \"float32\"\ncalibration_s = 20e-6",
     "17:17: controller.calibration_s: is too short for contact and sensor to settle; allowed: 0 "
     "(no calibration), or at least 0.000134 s"},
    {"tracked_and_calibrated", closed_loop, "arithmetic = \"float32\"",
     "arithmetic = \"float32\"\nfriction = \"tracked\"\ncalibration_s = 0.5e-3",
     "18:17: controller.calibration_s: 0.0005 s contradicts controller.friction = \"tracked\"; "
     "allowed: 0, or remove it"},
    {"calibrated_for_no_time", closed_loop, "arithmetic = \"float32\"",
     "arithmetic = \"float32\"\nfriction = \"calibrated\"\ncalibration_s = 0",
     "18:17: controller.calibration_s: 0 s contradicts controller.friction = \"calibrated\"; allowed: "
     "above 0, or remove it"},
    {"tracked_and_relearnt", closed_loop, "arithmetic = \"float32\"",
     "arithmetic = \"float32\"\nfriction = \"tracked\"\nrelearn_every_s = 1e-4",
     "18:19: controller.relearn_every_s: not used with controller.friction = \"tracked\"; remove it"},
    {"tracked_in_q15", closed_loop, "arithmetic = \"float32\"",
     "arithmetic = \"q15\"\nfriction = \"tracked\"",
     "16:14: controller.arithmetic: \"q15\" is too coarse for controller.friction = \"tracked\"; "
     "allowed: \"float32\", \"q31\", \"float64\""},
    {"tracked_without_a_dahl_map", coulomb_closed_loop, "arithmetic = \"float32\"",
     "arithmetic = \"float32\"\nfriction = \"tracked\"",
     "16:12: controller.friction: \"tracked\" needs friction.law = \"dahl\"; allowed: \"trusted\", "
     "\"calibrated\""},
    {"tracked_under_a_square_wave", tracked_loop, "max_force_amplitude_N = 1920.0",
     "max_force_amplitude_N = 1920.0\nwaveform = \"square\"",
     "18:12: controller.friction: \"tracked\" needs drive.waveform = \"cosine\"; allowed: "
     "\"trusted\", \"calibrated\""},
    {"tracked_with_a_weak_drive", tracked_loop, "max_force_amplitude_N = 1920.0",
     "max_force_amplitude_N = 0.9",
     "17:12: controller.friction: \"tracked\" needs a friction force below 2 % of the largest drive "
     "force; allowed: \"trusted\", \"calibrated\""},
    {"tracked_at_resonance", resonant_loop, "\"resonant\"", "\"resonant\"\nfriction = \"tracked\"",
     "22:12: controller.friction: \"tracked\" compares the force with the ratio that the amplitude is fed "
     "forward for, and with controller.vibration = \"resonant\" an observer moves the amplitude; allowed: "
     "\"trusted\", \"calibrated\", or no controller.vibration"},
    {"tracked_and_damped", damped_loop, "\"damped\"", "\"damped\"\nfriction = \"tracked\"",
     "19:12: controller.friction: \"tracked\" compares the force with the ratio that the amplitude is fed "
     "forward for, and with controller.vibration = \"damped\" an observer moves the amplitude; allowed: "
     "\"trusted\", \"calibrated\", or no controller.vibration"},
    {"tracked_with_a_bias", tracked_loop, "frequency_Hz = 60e3\nmax_force_amplitude_N = 1920.0",
     "frequency_Hz = 200e3\nmax_force_amplitude_N = 19200.0\nbias_limit_N = 1",
     "18:12: controller.friction: \"tracked\" takes the mean force of a few carrier periods for the "
     "friction, and the slow mode that drive.bias_limit_N is for swings for longer; allowed: \"trusted\", "
     "\"calibrated\", or drive.bias_limit_N = 0"},
    // Names
    {"unknown_key_near", open_loop, "mass_kg = 0.02", "mas_kg = 0.02",
     "2:1: plant.mas_kg: unknown key; did you mean mass_kg?"},
    {"unknown_key_unit_left_out", open_loop, "stiffness_N_per_m = 133e6", "stiffness = 133e6",
     "3:1: plant.stiffness: unknown key; did you mean stiffness_N_per_m?"},
    {"unknown_key_unit_wrong", open_loop, "frequency_Hz = 60e3", "frequency_kHz = 60",
     "12:1: drive.frequency_kHz: unknown key; did you mean frequency_Hz?"},
    {"order_that_is_not_built", open_loop, "tolerance = 1e-10", "tolerance = 1e-10\norder = 9",
     "17:9: solver.order: 9 is not built; allowed: 8, 12, 16"},
    {"unknown_key_far", open_loop, "tolerance = 1e-10", "tolerance = 1e-10\nzeal = 3",
     "17:1: solver.zeal: unknown key; allowed: method, tolerance, order, step_s"},
    {"key_of_another_table", open_loop, "[run]", "[run]\nmass_kg = 3",
     "18:1: run.mass_kg: unknown key; did you mean plant.mass_kg?"},
    {"key_without_table", open_loop, "[plant]", "coefficient = 0.1\n[plant]",
     "1:1: coefficient: unknown table; did you mean friction.coefficient?"},
    {"unknown_table_near", open_loop, "[friction]", "[fricton]",
     "4:2: fricton: unknown table; did you mean friction?"},
    {"unknown_table_far", open_loop, "[friction]", "[weather]",
     "4:2: weather: unknown table; allowed: plant, friction, sliding, load, transducer, drive, solver, "
     "run, "
     "controller, sensor, model_error, tolerance, true_values"},
    {"table_without_name", open_loop, "[friction]", "['']",
     "4:2: \"\": unknown table; allowed: plant, friction, sliding, load, transducer, drive, solver, "
     "run, controller, sensor, model_error, tolerance, true_values"},
    {"value_without_name", open_loop, "[plant]", "'' = '''\n'''\n[plant]",
     "1:1: \"\": unknown table; allowed: plant, friction, sliding, load, transducer, drive, solver, "
     "run, controller, sensor, model_error, tolerance, true_values"},
    {"key_without_name", open_loop, "[run]", "[run]\n\"\" = 3",
     "18:1: run.\"\": unknown key; allowed: start, duration_s, duration_periods, window_start_s, window_start_periods, settling_band, "
     "record, record_interval_s"},
    {"first_unknown_key_in_file_order", open_loop, "coefficient = 0.1",
     "zeta = 1\nalpha = 2\ncoefficient = 0.1",
     "6:1: friction.zeta: unknown key; allowed: law, coefficient, coefficient_profile, "
     "normal_force_N, normal_force_profile_N, contact_stiffness_N_per_m, initial_force_N, "
     "sign_convention, static_coefficient, "
     "stribeck_velocity_m_per_s, bristle_damping_N_s_per_m, viscous_friction_N_s_per_m, elements, "
     "fall_s_per_m, rise_s3_per_m3, normal_contact_stiffness_N_per_m"},
    {"control_character_in_key", open_loop, "mass_kg = 0.02", "\"mass\\nkg\" = 0.02",
     "2:1: plant.mass\\x0akg: unknown key; did you mean mass_kg?"},
    {"sub_table", open_loop, "[friction]", "[plant.mount]\nx = 1\n[friction]",
     "4:8: plant.mount: unknown key; allowed: mass_kg, stiffness_N_per_m, stiffness_profile, "
     "damping_N_s_per_m, "
     "initial_displacement_m, initial_velocity_m_per_s"},
    // Types
    {"string_for_number", open_loop, "mass_kg = 0.02", "mass_kg = \"0.02\"",
     "2:11: plant.mass_kg: is a string; allowed: a number, 1e-12 to 1e+06 kg"},
    {"boolean_for_number", open_loop, "coefficient = 0.1", "coefficient = true",
     "6:15: friction.coefficient: is a boolean; allowed: a number, 0 to 100"},
    {"date_for_number", open_loop, "frequency_Hz = 60e3", "frequency_Hz = 2013-01-01",
     "12:16: drive.frequency_Hz: is a date; allowed: a number, 0.001 to 1e+09 Hz"},
    {"table_for_number", open_loop, "tolerance = 1e-10", "tolerance = {}",
     "16:13: solver.tolerance: is a table; allowed: a number, 1e-15 to 0.01"},
    {"number_for_word", open_loop, "law = \"dahl\"", "law = 1",
     "5:7: friction.law: is an integer; allowed: \"dahl\", \"lugre\", \"iwan\", \"coulomb\", "
     "\"stribeck\", \"transverse_coulomb\", \"normal_coulomb\", \"none\""},
    {"real_for_integer", closed_loop, "adc_bits = 12", "adc_bits = 12.0",
     "19:12: sensor.adc_bits: is a real number; allowed: an integer, 4 to 32"},
    {"number_for_table", open_loop, "[plant]\nmass_kg = 0.02\nstiffness_N_per_m = 133e6",
     "plant = 3", "1:1: plant: is an integer; allowed: one table, [plant]"},
    {"array_of_tables", open_loop, "[plant]", "[[plant]]",
     "1:3: plant: is an array; allowed: one table, [plant]"},
    {"word_for_list", open_loop, "[\"displacement_m\"]", "\"displacement_m\"",
     "19:10: run.record: is a string; allowed: a list of \"displacement_m\", \"velocity_m_per_s\", "
     "\"friction_force_N\", \"drive_force_N\", \"sliding_velocity_m_per_s\", "
     "\"load_displacement_m\""},
    {"number_for_targets", closed_loop, "[[0.0, 0.4], [0.5e-3, 0.6]]", "0.4",
     "17:25: controller.target_friction_ratio: is a real number; allowed: a list of pairs "
     "[[time in s, number], …]"},
    // Values
    {"not_a_number", open_loop, "mass_kg = 0.02", "mass_kg = nan",
     "2:11: plant.mass_kg: is not finite; allowed: a number, 1e-12 to 1e+06 kg"},
    {"infinite", open_loop, "force_amplitude_N = 384.0", "force_amplitude_N = inf",
     "13:21: drive.force_amplitude_N: is not finite; allowed: a number, 0 to 1e+12 N"},
    {"infinite_negative", open_loop, "velocity_m_per_s = 0.0267", "velocity_m_per_s = -inf",
     "10:20: sliding.velocity_m_per_s: is not finite; allowed: a number, -1e+06 to 1e+06 m/s"},
    {"zero_mass", open_loop, "mass_kg = 0.02", "mass_kg = 0",
     "2:11: plant.mass_kg: 0 is out of range; allowed: 1e-12 to 1e+06 kg"},
    {"negative_stiffness", open_loop, "133e6", "-133e6",
     "3:21: plant.stiffness_N_per_m: -133000000 is out of range; allowed: 0 to 1e+18 N/m"},
    {"negative_damping", open_loop, "[friction]", "damping_N_s_per_m = -1\n[friction]",
     "4:21: plant.damping_N_s_per_m: -1 is out of range; allowed: 0 to 1e+12 N s/m"},
    {"zero_contact_stiffness", open_loop, "0.056e6", "0.0",
     "8:29: friction.contact_stiffness_N_per_m: 0 is out of range; allowed: 1e-06 to 1e+18 N/m"},
    {"initial_force_above_limit", open_loop, "[sliding]", "initial_force_N = 0.02\n[sliding]",
     "9:19: friction.initial_force_N: 0.02 is out of range; allowed: -0.01962 to 0.01962 N"},
    {"loose_tolerance", open_loop, "1e-10", "0.1",
     "16:13: solver.tolerance: 0.1 is out of range; allowed: 1e-15 to 0.01"},
    {"adc_bits_out_of_range", closed_loop, "adc_bits = 12", "adc_bits = 64",
     "19:12: sensor.adc_bits: 64 is out of range; allowed: 4 to 32"},
    {"sensor_gain_out_of_range", closed_loop, "adc_bits = 12", "force_gain = -101",
     "19:14: sensor.force_gain: -101 is out of range; allowed: -100 to 100"},
    {"sensor_gain_not_a_number", closed_loop, "adc_bits = 12", "velocity_gain = nan",
     "19:17: sensor.velocity_gain: is not finite; allowed: a number, -100 to 100"},
    {"force_offset_infinite", closed_loop, "adc_bits = 12", "force_offset_N = -inf",
     "19:18: sensor.force_offset_N: is not finite; allowed: a number, -1e+12 to 1e+12 N"},
    {"velocity_offset_out_of_range", closed_loop, "adc_bits = 12", "velocity_offset_m_per_s = 2e6",
     "19:27: sensor.velocity_offset_m_per_s: 2000000 is out of range; allowed: -1e+06 to 1e+06 "
     "m/s"},
    {"sensor_key_nearly_right", closed_loop, "adc_bits = 12", "force_offset = 1",
     "19:1: sensor.force_offset: unknown key; did you mean force_offset_N?"},
    {"model_error_out_of_range", closed_loop, "stiffness = 1.04", "stiffness = 0",
     "21:13: model_error.stiffness: 0 is out of range; allowed: 0.01 to 100"},
    {"number_too_large_for_a_double", open_loop, "133e6", "1e400",
     "3:26: toml: floating-point: '1e400' could not be interpreted as a "
     "value; allowed: TOML 1.0, in UTF-8"},
    {"unknown_word_near", open_loop, "\"dahl\"", "\"dhal\"",
     "5:7: friction.law: \"dhal\" is unknown; did you mean \"dahl\"? allowed: \"dahl\", "
     "\"lugre\", \"iwan\", \"coulomb\", \"stribeck\", \"transverse_coulomb\", "
     "\"normal_coulomb\", \"none\""},
    {"unknown_word_far", open_loop, "\"event_taylor\"", "\"magic\"",
     "15:10: solver.method: \"magic\" is unknown; allowed: \"event_taylor\", "
     "\"event_gauss\", \"strang\", \"rk4\", \"rk4_event\""},
    {"method_for_another_law", open_loop,
     "law = \"dahl\"\ncoefficient = 0.1\nnormal_force_N = 0.1962\n"
     "contact_stiffness_N_per_m = 0.056e6\n[sliding]\nvelocity_m_per_s = 0.0267\n[drive]\n"
     "frequency_Hz = 60e3\nforce_amplitude_N = 384.0\n[solver]\nmethod = \"event_taylor\"\n"
     "tolerance = 1e-10",
     "law = \"coulomb\"\ncoefficient = 0.1\n[sliding]\nvelocity_m_per_s = 0.0267\n"
     "[solver]\nmethod = \"strang\"\nstep_s = 1e-7\n[drive]\nfrequency_Hz = 60e3\n"
     "force_amplitude_N = 384.0",
     "10:10: solver.method: \"strang\" does not solve the friction law \"coulomb\"; allowed: "
     "\"event_taylor\", \"rk4\""},
    {"unknown_waveform", open_loop, "[solver]", "waveform = \"pulse\"\n[solver]",
     "14:12: drive.waveform: \"pulse\" is unknown; allowed: \"cosine\", \"square\", \"triangle\", "
     "\"sawtooth\""},
    {"force_into_a_transducer", open_loop, "[drive]",
     "[transducer]\nforce_factor_N_per_V = 16\nclamped_capacitance_F = 2e-6\n[drive]",
     "16:21: drive.force_amplitude_N: is a force, but with a [transducer] the drive is a voltage; "
     "allowed: voltage_amplitude_V"},
    {"limit_of_force_into_a_transducer", closed_loop, "[drive]",
     "[transducer]\nforce_factor_N_per_V = 16\nclamped_capacitance_F = 2e-6\n[drive]",
     "15:25: drive.max_force_amplitude_N: is a force, but with a [transducer] the drive is a "
     "voltage; allowed: max_voltage_amplitude_V"},
    {"voltage_without_a_transducer", open_loop, "force_amplitude_N = 384.0",
     "voltage_amplitude_V = 10",
     "13:23: drive.voltage_amplitude_V: is a voltage, but without a [transducer] the drive is a "
     "force; allowed: force_amplitude_N"},
    {"transducer_without_a_drive", open_loop,
     "[drive]\nfrequency_Hz = 60e3\nforce_amplitude_N = 384.0",
     "[transducer]\nforce_factor_N_per_V = 16\nclamped_capacitance_F = 2e-6",
     "11:2: transducer: not used without a table [drive]; remove it"},
    {"transducer_under_a_square_wave", open_loop,
     "[drive]\nfrequency_Hz = 60e3\nforce_amplitude_N = 384.0",
     "[transducer]\nforce_factor_N_per_V = 16\nclamped_capacitance_F = 2e-6\n[drive]\n"
     "frequency_Hz = 60e3\nvoltage_amplitude_V = 10\nwaveform = \"square\"",
     "17:12: drive.waveform: \"square\" is not for a [transducer]; allowed: \"cosine\""},
    {"steady_while_the_frequency_changes", open_loop,
     "[solver]\nmethod = \"event_taylor\"\ntolerance = 1e-10\n[run]",
     "frequency_profile = [[0, 60e3], [1e-3, 61e3]]\n[run]\nstart = \"steady\"",
     "16:9: run.start: nothing is steady under a drive.frequency_profile; allowed: \"given\""},
    {"frequency_word_coarser_than_the_carrier", open_loop, "frequency_Hz = 60e3",
     "frequency_Hz = 60e3\nfrequency_resolution_Hz = 1e6",
     "13:27: drive.frequency_resolution_Hz: 1e+06 Hz is above the carrier frequency; allowed: at "
     "most 60000 Hz"},
    {"frequency_profile_in_closed_loop", closed_loop, "frequency_Hz = 60e3",
     "frequency_Hz = 60e3\nfrequency_profile = [[0, 60e3]]",
     "12:1: drive.frequency_profile: not used in closed loop: the controller sets the amplitude; "
     "remove it"},
    {"vibration_unknown", resonant_loop, "\"resonant\"", "\"resonating\"",
     "21:13: controller.vibration: \"resonating\" is unknown; allowed: \"resonant\", "
     "\"damped\""},
    {"resonance_without_a_transducer", resonant_loop,
     "[transducer]\nforce_factor_N_per_V = 1.0\nclamped_capacitance_F = "
     "2e-9\n[drive]\nfrequency_Hz = 60e3\nmax_voltage_amplitude_V = 8",
     "[drive]\nfrequency_Hz = 60e3\nmax_force_amplitude_N = 8",
     "18:13: controller.vibration: \"resonant\" needs a table [transducer], whose voltage drives "
     "the resonance"},
    {"resonance_with_a_force_limit", resonant_loop, "max_voltage_amplitude_V = 8",
     "max_force_amplitude_N = 8",
     "16:25: drive.max_force_amplitude_N: is a force, but with a [transducer] the drive is a "
     "voltage; allowed: max_voltage_amplitude_V"},
    {"resonance_unseen", resonant_loop, "[sensor]\nvibration = \"velocity\"\n", "",
     "1:1: sensor.vibration: missing: controller.vibration = \"resonant\" observes the vibration; "
     "required: \"velocity\" or \"motional_current\""},
    {"resonance_in_q15", resonant_loop, "\"float32\"", "\"q15\"",
     "20:14: controller.arithmetic: \"q15\" is too coarse for controller.vibration = \"resonant\"; "
     "allowed: \"float32\", \"q31\", \"float64\""},
    {"resonance_without_losses", resonant_loop, "damping_N_s_per_m = 37.7\n", "",
     "1:2: plant.damping_N_s_per_m: is 0, and a resonance without losses has no steady vibration; "
     "allowed: above 0 with controller.vibration = \"resonant\""},
    {"frequency_range_without_the_start", resonant_loop, "vibration = \"resonant\"",
     "vibration = \"resonant\"\nfrequency_range_Hz = [61e3, 62e3]",
     "22:22: controller.frequency_range_Hz: drive.frequency_Hz, where the drive starts, is 60000 "
     "Hz; allowed: a range that begins below and ends above it"},
    {"frequency_range_too_wide", resonant_loop, "vibration = \"resonant\"",
     "vibration = \"resonant\"\nfrequency_range_Hz = [50e3, 62e3]",
     "22:22: controller.frequency_range_Hz: [50000, 62000] leaves the range that the controller "
     "can follow; allowed: 56400 to 63600 Hz, 6 % about drive.frequency_Hz"},
    {"frequency_range_turned_round", resonant_loop, "vibration = \"resonant\"",
     "vibration = \"resonant\"\nfrequency_range_Hz = [62e3, 58e3]",
     "22:22: controller.frequency_range_Hz: 62000 is not below 58000; allowed: the lowest, then "
     "the highest"},
    {"frequency_range_of_one_number", resonant_loop, "vibration = \"resonant\"",
     "vibration = \"resonant\"\nfrequency_range_Hz = [60e3]",
     "22:22: controller.frequency_range_Hz: is an array of 1; allowed: two numbers [lowest, "
     "highest], 0.001 to 1e+09 Hz"},
    {"frequency_range_is_no_list", resonant_loop, "vibration = \"resonant\"",
     "vibration = \"resonant\"\nfrequency_range_Hz = 60e3",
     "22:22: controller.frequency_range_Hz: is a real number; allowed: two numbers [lowest, "
     "highest], 0.001 to 1e+09 Hz"},
    {"frequency_range_fed_forward", resonant_loop, "vibration = \"resonant\"",
     "frequency_range_Hz = [58e3, 62e3]",
     "21:1: controller.frequency_range_Hz: not used without controller.vibration = \"resonant\"; "
     "remove it"},
    {"shaping_at_resonance", resonant_loop, "vibration = \"resonant\"",
     "vibration = \"resonant\"\nshaping = \"none\"",
     "22:1: controller.shaping: not used with controller.vibration = \"resonant\"; remove it"},
    {"current_limit_below_the_capacitance", resonant_loop, "[run]",
     "max_current_amplitude_A = 1e-3\n[run]",
     "17:27: drive.max_current_amplitude_A: 0.001 A is less than what the clamped capacitance "
     "alone takes at the 2.759 V that the easiest target needs; allowed: above 0.002081 A"},
    {"current_limit_fed_forward", resonant_loop,
     "frequency_Hz = 60e3\nmax_voltage_amplitude_V = 8\n[run]\nduration_s = "
     "2e-3\n[controller]\narithmetic = \"float32\"\nvibration = \"resonant\"",
     "frequency_Hz = 50e3\nmax_voltage_amplitude_V = 8\nmax_current_amplitude_A = "
     "1\n[run]\nduration_s = 2e-3\n[controller]\narithmetic = \"float32\"",
     "17:1: drive.max_current_amplitude_A: not used without controller.vibration = \"resonant\"; "
     "remove it"},
    {"vibration_sensor_fed_forward", resonant_loop,
     "frequency_Hz = 60e3\nmax_voltage_amplitude_V = 8\n[run]\nduration_s = "
     "2e-3\n[controller]\narithmetic = \"float32\"\nvibration = \"resonant\"",
     "frequency_Hz = 50e3\nmax_voltage_amplitude_V = 800\n[run]\nduration_s = "
     "2e-3\n[controller]\narithmetic = \"float32\"",
     "23:1: sensor.vibration: not used without controller.vibration; remove it"},
    {"force_noise_without_a_force_sensor", resonant_loop, "[sensor]",
     "[sensor]\nforce = false\nforce_noise_N = 1e-4",
     "25:1: sensor.force_noise_N: not used with sensor.force = false; remove it"},
    {"calibration_without_a_force_sensor", resonant_loop, "[sensor]\n",
     "calibration_s = 1e-3\n[sensor]\nforce = false\n",
     "23:1: controller.calibration_s: not used with sensor.force = false; remove it"},
    {"force_sensor_by_a_word", resonant_loop, "[sensor]", "[sensor]\nforce = \"no\"",
     "24:9: sensor.force: is a string; allowed: true or false"},
    {"shaping_range_of_a_known_mode", closed_loop, "arithmetic = \"float32\"",
     "arithmetic = \"float32\"\nshaping = \"notch\"\nshaping_range = 0.1",
     "18:1: controller.shaping_range: not used without controller.shaping = \"robust\"; remove it"},
    {"shaping_range_of_the_default", closed_loop, "arithmetic = \"float32\"",
     "arithmetic = \"float32\"\nshaping_range = 0.1",
     "17:1: controller.shaping_range: not used without controller.shaping = \"robust\"; remove it"},
    {"shaping_range_too_wide", closed_loop, "arithmetic = \"float32\"",
     "arithmetic = \"float32\"\nshaping = \"robust\"\nshaping_range = 0.6",
     "18:17: controller.shaping_range: 0.6 is out of range; allowed: 0.0001 to 0.5"},
    {"robust_shaping_beside_damping", damped_loop, "\"damped\"", "\"damped\"\nshaping = \"robust\"",
     "19:1: controller.shaping: not used with controller.vibration = \"damped\"; remove it"},
    {"frequency_word_too_coarse_for_a_resonance", resonant_loop, "[run]",
     "frequency_resolution_Hz = 2e3\n[run]",
     "17:27: drive.frequency_resolution_Hz: 2000 Hz is too coarse to follow a resonance; allowed: "
     "0, or 0.000228 to 914.728 Hz"},
    {"frequency_word_too_fine_for_a_resonance", resonant_loop, "[run]",
     "frequency_resolution_Hz = 1e-6\n[run]",
     "17:27: drive.frequency_resolution_Hz: 1e-06 Hz is too fine to follow a resonance; allowed: "
     "0, or 0.000224 to 930.232 Hz"},
    {"resonance_without_a_spring", resonant_loop, "stiffness_N_per_m = 2842446067.7",
     "stiffness_N_per_m = 0",
     "3:21: plant.stiffness_N_per_m: is 0, and a mass without a spring has no resonance; allowed: "
     "above 0 with controller.vibration = \"resonant\""},
    {"drive_too_strong_for_a_resonance", resonant_loop, "max_voltage_amplitude_V = 8",
     "max_voltage_amplitude_V = 8000",
     "16:27: drive.max_voltage_amplitude_V: adds 11.4 times the vibration sensor's range of 0.2927 "
     "m/s in a carrier period; allowed: at most 351.2 V, or a larger "
     "sensor.vibration_full_scale_m_per_s"},
    {"vibration_full_scale_too_wide", resonant_loop, "[sensor]",
     "[sensor]\nvibration_full_scale_m_per_s = 1e3",
     "24:32: sensor.vibration_full_scale_m_per_s: 1000 m/s is too much beside the fastest sliding, "
     "which has the same range; allowed: at most 133.5 m/s"},
    {"vibration_full_scale_below_the_sliding", resonant_loop, "[sensor]",
     "[sensor]\nvibration_full_scale_m_per_s = 0.01",
     "24:32: sensor.vibration_full_scale_m_per_s: 0.01 m/s is below what a target needs; allowed: "
     "above 0.07318 m/s"},
    {"vibration_hidden_by_coarse_codes", resonant_loop, "[sensor]", "[sensor]\nvibration_bits = 4",
     "24:18: sensor.vibration_bits: noise and converter hide a vibration below 0.169 m/s, and a "
     "target needs 0.0732 m/s; allowed: at least 6 bits, or a lower target"},
    {"vibration_full_scale_below_a_target", resonant_loop, "[sensor]",
     "[sensor]\nvibration_full_scale_m_per_s = 0.05",
     "24:32: sensor.vibration_full_scale_m_per_s: 0.05 m/s is below what a target needs; allowed: "
     "above 0.07318 m/s"},
    {"vibration_hidden_by_noise", resonant_loop, "[sensor]",
     "[sensor]\nvibration_noise_m_per_s = 0.02",
     "24:27: sensor.vibration_noise_m_per_s: noise and converter hide a vibration below 0.32 m/s, "
     "and a target needs 0.0732 m/s; allowed: at most 0.00457 m/s, or a lower target"},
    {"drive_too_weak_to_be_seen", resonant_loop + "vibration_noise_m_per_s = 2e-4\n",
     "max_voltage_amplitude_V = 8", "max_voltage_amplitude_V = 1e-3",
     "16:27: drive.max_voltage_amplitude_V: 0.001 V give a vibration of 2.65e-05 m/s at most, and the noise "
     "and the converter of the vibration sensor hide one below 0.0032 m/s; allowed: above 0.1207 V"},
    {"resonance_at_standstill", resonant_loop, "velocity_m_per_s = 0.0267", "velocity_m_per_s = 0",
     "10:20: sliding.velocity_m_per_s: is 0 all the time, where no vibration changes the friction; "
     "allowed: another velocity with controller.vibration = \"resonant\""},
    {"damped_by_nothing", damped_loop, "vibration = \"velocity\"\n", "force = false\n",
     "21:9: sensor.force: false, and without sensor.vibration nothing tells of the vibration; "
     "required: one of the two"},
    {"damped_by_bits_alone", damped_loop, "vibration = \"velocity\"\n", "vibration_bits = 12\n",
     "21:1: sensor.vibration_bits: not used without sensor.vibration; remove it"},
    {"damped_by_a_current_that_is_none", damped_loop, "\"velocity\"", "\"motional_current\"",
     "21:13: sensor.vibration: \"motional_current\" needs a table [transducer], whose current it "
     "is; allowed: \"velocity\""},
    {"damped_in_q15", damped_loop, "\"float32\"", "\"q15\"",
     "17:14: controller.arithmetic: \"q15\" is too coarse for controller.vibration = \"damped\"; "
     "allowed: \"float32\", \"q31\", \"float64\""},
    {"damped_with_shaping", damped_loop, "\"damped\"", "\"damped\"\nshaping = \"notch\"",
     "19:1: controller.shaping: not used with controller.vibration = \"damped\"; remove it"},
    {"damped_in_a_frequency_range", damped_loop, "\"damped\"",
     "\"damped\"\nfrequency_range_Hz = [58e3, 62e3]",
     "19:1: controller.frequency_range_Hz: not used with controller.vibration = \"damped\"; remove "
     "it"},
    {"damped_with_a_slew_limit", damped_loop, "[run]", "max_force_slew_N_per_s = 1e8\n[run]",
     "14:1: drive.max_force_slew_N_per_s: not used with controller.vibration = \"damped\"; remove "
     "it"},
    {"damped_under_a_square_wave", damped_loop, "[run]", "waveform = \"square\"\n[run]",
     "14:12: drive.waveform: \"square\" is not for controller.vibration = \"damped\"; allowed: "
     "\"cosine\""},
    {"damped_under_a_ramp", damped_loop, "[run]", "interpolation = \"linear\"\n[run]",
     "14:17: drive.interpolation: \"linear\" is not for controller.vibration = \"damped\", whose "
     "observer foresees amplitudes that change at once; allowed: \"step\", or no controller.vibration"},
    {"damped_force_factor_of_a_force", damped_loop, "vibration = \"velocity\"\n",
     "vibration = \"velocity\"\n[model_error]\nforce_factor = 1.1\n",
     "23:1: model_error.force_factor: not used without a [transducer]; remove it"},
    {"damped_without_a_spring", damped_loop, "133e6", "0",
     "3:21: plant.stiffness_N_per_m: is 0, and a mass without a spring has no natural mode; "
     "allowed: "
     "above 0 with controller.vibration = \"damped\""},
    {"damped_already", damped_loop, "damping_N_s_per_m = 1\n", "damping_N_s_per_m = 4000\n",
     "4:21: plant.damping_N_s_per_m: leaves no natural mode to damp; allowed: below 2.93e+03 N s/m "
     "with controller.vibration = \"damped\""},
    {"damped_on_its_resonance", damped_loop,
     "damping_N_s_per_m = 1\n[friction]\nlaw = \"dahl\"\ncoefficient = 0.1\n"
     "contact_stiffness_N_per_m = 0.056e6\n[sliding]\nvelocity_m_per_s = 0.0267\n[drive]\n"
     "frequency_Hz = 60e3",
     "[friction]\nlaw = \"dahl\"\ncoefficient = 0.1\ncontact_stiffness_N_per_m = 0.056e6\n"
     "[sliding]\nvelocity_m_per_s = 0.0267\n[drive]\nfrequency_Hz = 12978.7",
     "11:16: drive.frequency_Hz: is the plant's natural frequency, and with so little damping the "
     "vibration never settles; allowed: another frequency, more plant.damping_N_s_per_m, or with a "
     "[transducer] controller.vibration = \"resonant\""},
    {"damped_at_standstill", damped_loop, "velocity_m_per_s = 0.0267", "velocity_m_per_s = 0",
     "10:20: sliding.velocity_m_per_s: is 0 all the time, where no vibration changes the friction; "
     "allowed: another velocity with controller.vibration = \"damped\""},
    {"damped_full_scale_below_the_drive", damped_loop, "vibration = \"velocity\"\n",
     "vibration = \"velocity\"\nvibration_full_scale_m_per_s = 0.3\n",
     "22:32: sensor.vibration_full_scale_m_per_s: 0.3 m/s does not suit full drive, whose steady "
     "vibration is 0.2671 m/s; allowed: 0.5343 to 17.09 m/s"},
    {"damped_drive_too_weak", damped_loop, "1920.0", "1",
     "13:25: drive.max_force_amplitude_N: vibrates at 0.000139 m/s, too little for a sliding of "
     "0.0267 m/s; allowed: at least 11.9934 N with controller.vibration = \"damped\""},
    {"current_limit_of_a_force", resonant_loop,
     "[transducer]\nforce_factor_N_per_V = 1.0\nclamped_capacitance_F = 2e-9\n[drive]\n"
     "frequency_Hz = 60e3\nmax_voltage_amplitude_V = 8",
     "[drive]\nfrequency_Hz = 50e3\nmax_force_amplitude_N = 8\nmax_current_amplitude_A = 1",
     "14:1: drive.max_current_amplitude_A: not used without a [transducer]; remove it"},
    {"frequency_profile_at_resonance", resonant_loop, "frequency_Hz = 60e3",
     "frequency_Hz = 60e3\nfrequency_profile = [[0, 60e3]]",
     "16:1: drive.frequency_profile: not used in closed loop: the controller sets the amplitude; "
     "remove it"},
    {"spring_told_twice", open_loop, "stiffness_N_per_m = 133e6",
     "stiffness_N_per_m = 133e6\nstiffness_profile = [[0, 133e6]]",
     "4:1: plant.stiffness_profile: excludes stiffness_N_per_m; allowed: one of the two"},
    {"method_for_another_waveform", open_loop,
     "[solver]\nmethod = \"event_taylor\"\ntolerance = 1e-10",
     "waveform = \"square\"\n[solver]\nmethod = \"strang\"\nstep_s = 1e-7",
     "16:10: solver.method: strang does not follow the waveform \"square\"; allowed: "
     "\"event_taylor\", \"rk4\""},
    {"order_for_another_waveform", open_loop, "[solver]",
     "waveform = \"square\"\n[solver]\norder = 8",
     "16:9: solver.order: 8 does not follow the waveform \"square\"; allowed: 16"},
    {"static_friction_below_that_of_sliding", open_loop, "\"dahl\"",
     "\"lugre\"\nstatic_coefficient = 0.05",
     "6:22: friction.static_coefficient: 0.05 is out of range; allowed: 0.1 to 100"},
    {"curve_that_falls_below_zero", open_loop, "\"dahl\"\ncoefficient = 0.1",
     "\"stribeck\"\nfall_s_per_m = 3\nrise_s3_per_m3 = 399\ncoefficient = 0.1",
     "7:18: friction.rise_s3_per_m3: 399 lets the friction fall below zero; allowed: at least 400 "
     "s^3/m^3 with this fall_s_per_m"},
    {"more_elements_than_there_are", open_loop, "\"dahl\"", "\"iwan\"\nelements = 9",
     "6:12: friction.elements: 9 is out of range; allowed: 1 to 8"},
    {"part_of_an_element", open_loop, "\"dahl\"", "\"iwan\"\nelements = 1.5",
     "6:12: friction.elements: is a real number; allowed: an integer, 1 to 8"},
    {"transverse_without_slip", open_loop,
     "\"dahl\"\ncoefficient = 0.1\nnormal_force_N = 0.1962\ncontact_stiffness_N_per_m = "
     "0.056e6\n[sliding]\n"
     "velocity_m_per_s = 0.0267",
     "\"transverse_coulomb\"\ncoefficient = 0.1\n[sliding]\nvelocity_m_per_s = 0",
     "8:20: sliding.velocity_m_per_s: a speed that stays 0 leaves the friction law "
     "\"transverse_coulomb\" without a direction; allowed: a speed that at most passes 0"},
    {"transverse_has_no_sign", open_loop,
     "\"dahl\"\ncoefficient = 0.1\nnormal_force_N = 0.1962\ncontact_stiffness_N_per_m = 0.056e6",
     "\"transverse_coulomb\"\ncoefficient = 0.1\nsign_convention = \"dissipative\"",
     "7:1: friction.sign_convention: not used with friction.law = \"transverse_coulomb\"; remove "
     "it"},
    {"normal_without_its_stiffness", open_loop, "\"dahl\"", "\"normal_coulomb\"",
     "4:2: friction.normal_contact_stiffness_N_per_m: missing; required: a number, 1e-06 to 1e+18 "
     "N/m"},
    {"dahl_has_no_bristles", open_loop, "[sliding]", "static_coefficient = 0.2\n[sliding]",
     "9:1: friction.static_coefficient: not used with friction.law = \"dahl\"; remove it"},
    {"unknown_channel", open_loop, "[\"displacement_m\"]", "[\"displacment_m\"]",
     "19:11: run.record[0]: \"displacment_m\" is unknown; did you mean \"displacement_m\"? "
     "allowed: \"displacement_m\", \"velocity_m_per_s\", \"friction_force_N\", "
     "\"drive_force_N\", \"sliding_velocity_m_per_s\", "
     "\"load_displacement_m\""},
    {"channel_twice", open_loop, "[\"displacement_m\"]", "[\"displacement_m\", \"displacement_m\"]",
     "19:29: run.record[1]: \"displacement_m\" is there twice; allowed: each once"},
    // A load
    {"load_beside_sliding", open_loop, "[drive]", "[load]\nmass_kg = 1\n[drive]",
     "9:2: sliding: not used with a [load], whose velocity follows from what acts on it; remove it"},
    {"load_without_mass", open_loop, "[sliding]\nvelocity_m_per_s = 0.0267", "[load]",
     "9:2: load.mass_kg: missing; required: a number, 1e-12 to 1e+09 kg"},
    {"load_of_another_solver", open_loop,
     "[sliding]\nvelocity_m_per_s = 0.0267\n[drive]\nfrequency_Hz = 60e3\nforce_amplitude_N = "
     "384.0\n[solver]\nmethod = \"event_taylor\"",
     "[load]\nmass_kg = 1\n[drive]\nfrequency_Hz = 60e3\nforce_amplitude_N = 384.0\n[solver]\n"
     "method = \"strang\"",
     "15:10: solver.method: \"strang\" does not solve a [load]; allowed: \"event_taylor\", \"rk4\""},
    {"load_that_is_pulled_by_nothing", open_loop, "[sliding]\nvelocity_m_per_s = 0.0267",
     "[load]\nmass_kg = 1\npull_profile_m_per_s = [[0, 1]]",
     "11:1: load.pull_profile_m_per_s: not used without a load.spring_N_per_m above 0; remove it"},
    {"load_under_friction_that_changes", moving_open_loop, "[sliding]\nvelocity_m_per_s = 0.0267",
     "[load]\nmass_kg = 1",
     "8:2: load: not used with friction.normal_force_profile_N; allowed: a constant value in its "
     "place"},
    {"load_across_the_vibration", open_loop,
     "\"dahl\"\ncoefficient = 0.1\nnormal_force_N = 0.1962\ncontact_stiffness_N_per_m = "
     "0.056e6\n[sliding]\nvelocity_m_per_s = 0.0267",
     "\"transverse_coulomb\"\ncoefficient = 0.1\n[load]\nmass_kg = 1",
     "7:2: load: not used with friction.law = \"transverse_coulomb\": a body at rest in such a "
     "contact is not modelled; allowed: a law of friction along the vibration"},
    {"load_as_printed", open_loop, "0.056e6\n[sliding]\nvelocity_m_per_s = 0.0267",
     "0.056e6\nsign_convention = \"as_printed\"\n[load]\nmass_kg = 1",
     "10:2: load: not used with friction.sign_convention = \"as_printed\", under which the friction "
     "on the body has no reaction; allowed: \"dissipative\""},
    {"load_displacement_without_load", open_loop, "[\"displacement_m\"]",
     "[\"load_displacement_m\"]",
     "19:10: run.record: \"load_displacement_m\" is not there without a [load]; remove it"},
    // Missing
    {"missing_key", open_loop, "mass_kg = 0.02\n", "",
     "1:2: plant.mass_kg: missing; required: a number, 1e-12 to 1e+06 kg"},
    {"missing_word", open_loop, "law = \"dahl\"\n", "",
     "4:2: friction.law: missing; required: \"dahl\" or \"lugre\" or \"iwan\" or \"coulomb\" or "
     "\"stribeck\" or \"transverse_coulomb\" or \"normal_coulomb\" or \"none\""},
    {"missing_table", open_loop, "[sliding]\nvelocity_m_per_s = 0.0267\n", "",
     "1:1: sliding: missing; required: a table [sliding], or [load]"},
    {"missing_velocity", open_loop, "velocity_m_per_s = 0.0267\n", "",
     "9:2: sliding.velocity_m_per_s: missing; required: velocity_m_per_s or profile"},
    {"missing_duration", open_loop, "duration_periods = 20\n", "",
     "17:2: run.duration_s: missing; required: duration_s or duration_periods"},
    {"missing_interval", open_loop, "record_interval_s = 1e-6\n", "",
     "17:2: run.record_interval_s: missing; required: a number, 1e-15 to 1e+09 s"},
    {"missing_amplitude", open_loop, "force_amplitude_N = 384.0\n", "",
     "11:2: drive.force_amplitude_N: missing; required: a number, 0 to 1e+12 N"},
    {"missing_actuator_limit", closed_loop, "max_force_amplitude_N = 1920.0\n", "",
     "10:2: drive.max_force_amplitude_N: missing; required: a number, 1e-12 to 1e+12 N"},
    {"missing_drive_in_closed_loop", closed_loop,
     "[drive]\nfrequency_Hz = 60e3\nmax_force_amplitude_N = 1920.0\n", "",
     "1:1: drive: missing; required: a table [drive] for the [controller] to act by"},
    {"missing_target", closed_loop, "target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]\n", "",
     "15:2: controller.target_friction_ratio: missing; required: target_friction_ratio or "
     "target_friction_force_N or target_texture"},
    {"two_targets", closed_loop, "target_friction_ratio",
     "target_friction_force_N = [[0.0, 0.01]]\ntarget_friction_ratio",
     "18:1: controller.target_friction_ratio: excludes target_friction_force_N; allowed: one of the "
     "two"},
    {"target_force_above_the_friction", closed_loop,
     "target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]",
     "target_friction_force_N = [[0.0, 0.02]]",
     "17:27: controller.target_friction_force_N: 0.02 N is more than the friction, which is 0.01962 N "
     "at most; allowed: above 0, at most 0.01962 N"},
    {"target_force_of_zero", closed_loop, "target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]",
     "target_friction_force_N = [[0.0, 0]]",
     "17:34: controller.target_friction_force_N[0][1]: 0 is out of range; allowed: above 0, at most "
     "1e+12 N"},
    {"target_force_below_a_code", closed_loop,
     "arithmetic = \"float32\"\ntarget_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]",
     "arithmetic = \"q31\"\ntarget_friction_force_N = [[0.0, 1e-12]]",
     "17:27: controller.target_friction_force_N: 1e-12 N is less than the controller's arithmetic "
     "resolves of a force, 1.83e-11 N; allowed: at least 1.82726e-11 N"},
    {"target_force_late", closed_loop, "target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]",
     "target_friction_force_N = [[1e-4, 0.01]]",
     "17:27: controller.target_friction_force_N: begins at 0.0001 s; allowed: a first time of 0 s"},
    {"target_force_relearnt", closed_loop, "target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]",
     "target_friction_force_N = [[0.0, 0.01]]\nrelearn_every_s = 1e-3",
     "18:1: controller.relearn_every_s: not used with target_friction_force_N, where feedback holds "
     "the force whatever the friction; remove it"},
    {"target_force_with_a_warning", closed_loop,
     "target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]",
     "target_friction_force_N = [[0.0, 0.01]]\nmismatch_warning = 1.1",
     "18:1: controller.mismatch_warning: not used with target_friction_force_N, where feedback holds "
     "the force whatever the friction; remove it"},
    {"target_force_tracked", closed_loop, "target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]",
     "target_friction_force_N = [[0.0, 0.01]]\nfriction = \"tracked\"",
     "18:12: controller.friction: \"tracked\" is not for target_friction_force_N, where feedback "
     "holds the force whatever the friction; allowed: \"trusted\", \"calibrated\""},
    {"target_force_without_a_sensor", damped_loop, "target_friction_ratio = [[0.0, 0.5]]\n[sensor]",
     "target_friction_force_N = [[0.0, 0.01]]\n[sensor]\nforce = false",
     "21:9: sensor.force: false, but feedback on the force holds controller.target_friction_force_N; "
     "allowed: true, or a target_friction_ratio"},
    {"target_force_that_is_not_read", closed_loop,
     "target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]\n[sensor]\nadc_bits = 12\n[model_error]\n",
     "target_friction_force_N = [[0.0, 0.015]]\n[sensor]\nforce_full_scale_N = 0.012\n"
     "[model_error]\ncoefficient = 0.5\n",
     "17:27: controller.target_friction_force_N: 0.015 N is not below sensor.force_full_scale_N, 0.012 "
     "N; allowed: at most 0.012 N"},
    {"texture_beside_a_ratio", closed_loop, "target_friction_ratio",
     "target_texture = { period_m = 1e-4, ratio = [0.4, 0.6] }\ntarget_friction_ratio",
     "18:1: controller.target_friction_ratio: excludes target_texture; allowed: one of the two"},
    {"texture_beside_a_force", closed_loop, "target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]",
     "target_texture = { period_m = 1e-4, ratio = [0.4, 0.6] }\n"
     "target_friction_force_N = [[0.0, 0.01]]",
     "18:1: controller.target_friction_force_N: excludes target_texture; allowed: one of the two"},
    {"texture_of_a_number", closed_loop, "target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]",
     "target_texture = 0.5",
     "17:18: controller.target_texture: is a real number; allowed: { period_m = a length, ratio = "
     "[number, number, …] }, or force_N in place of ratio"},
    {"texture_without_a_period", closed_loop, "target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]",
     "target_texture = { ratio = [0.4, 0.6] }",
     "17:18: controller.target_texture: has no period_m; allowed: { period_m = a length, ratio = "
     "[number, number, …] }, or force_N in place of ratio"},
    {"texture_of_nothing", closed_loop, "target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]",
     "target_texture = { period_m = 1e-4 }",
     "17:18: controller.target_texture: has neither ratio nor force_N; allowed: one of the two"},
    {"texture_of_both", closed_loop, "target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]",
     "target_texture = { period_m = 1e-4, ratio = [0.4, 0.6], force_N = [0.01, 0.012] }",
     "17:18: controller.target_texture: has both ratio and force_N; allowed: one of the two"},
    {"texture_with_a_strange_key", closed_loop,
     "target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]",
     "target_texture = { period_m = 1e-4, ratios = [0.4, 0.6] }",
     "17:18: controller.target_texture: has an unknown ratios; allowed: { period_m = a length, ratio = "
     "[number, number, …] }, or force_N in place of ratio"},
    {"texture_of_one_number", closed_loop, "target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]",
     "target_texture = { period_m = 1e-4, ratio = [0.4] }",
     "17:45: controller.target_texture.ratio: is an array of 1; allowed: a list of 2 to 1024 numbers, "
     "above 0, at most 1"},
    {"texture_of_a_ratio_above_1", closed_loop,
     "target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]",
     "target_texture = { period_m = 1e-4, ratio = [0.4, 1.1] }",
     "17:51: controller.target_texture.ratio[1]: 1.1 is out of range; allowed: above 0, at most 1"},
    {"texture_of_a_negative_period", closed_loop,
     "target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]",
     "target_texture = { period_m = -1e-4, ratio = [0.4, 0.6] }",
     "17:31: controller.target_texture.period_m: -0.0001 is out of range; allowed: 1e-12 to 1000 m"},
    {"texture_above_the_friction", closed_loop,
     "target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]",
     "target_texture = { period_m = 1e-4, force_N = [0.01, 0.02] }",
     "17:18: controller.target_texture: 0.02 N is more than the friction, which is 0.01962 N at most; "
     "allowed: above 0, at most 0.01962 N"},
    {"texture_tracked", closed_loop, "target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]",
     "target_texture = { period_m = 1e-4, ratio = [0.4, 0.6] }\nfriction = \"tracked\"",
     "18:12: controller.friction: \"tracked\" is not for target_texture, under which the loop never "
     "settles; allowed: \"trusted\", \"calibrated\""},
    {"texture_relearnt", closed_loop, "target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]",
     "target_texture = { period_m = 1e-4, ratio = [0.4, 0.6] }\nrelearn_every_s = 1e-3",
     "18:1: controller.relearn_every_s: not used with target_texture, which changes all the time; "
     "remove it"},
    {"texture_too_fine", closed_loop, "target_friction_ratio = [[0.0, 0.4], [0.5e-3, 0.6]]",
     "target_texture = { period_m = 1e-6, ratio = [0.4, 0.6] }",
     "17:18: controller.target_texture: a period_m of 1e-06 m is too short for steps of 1.67e-05 s at "
     "0.0267 m/s; allowed: 3.56001e-06 to 598.775 m"},
    {"missing_step", open_loop, "method = \"event_taylor\"\ntolerance = 1e-10", "method = \"rk4\"",
     "14:2: solver.step_s: missing; required: a number, 1e-15 to 1 s"},
    // Keys that the scene cannot use
    {"law_none_uses_nothing", open_loop, "\"dahl\"", "\"none\"",
     "6:1: friction.coefficient: not used with friction.law = \"none\"; remove it"},
    {"coulomb_has_no_contact_stiffness", open_loop, "\"dahl\"", "\"coulomb\"",
     "8:1: friction.contact_stiffness_N_per_m: not used with friction.law = \"coulomb\"; remove "
     "it"},
    {"coulomb_has_no_initial_force", open_loop,
     "law = \"dahl\"\ncoefficient = 0.1\nnormal_force_N = 0.1962\n"
     "contact_stiffness_N_per_m = 0.056e6",
     "law = \"coulomb\"\ncoefficient = 0.1\ninitial_force_N = 0",
     "7:1: friction.initial_force_N: not used with friction.law = \"coulomb\"; remove it"},
    {"taylor_has_no_step", open_loop, "tolerance = 1e-10", "step_s = 1e-8",
     "16:1: solver.step_s: not used with solver.method = \"event_taylor\"; remove it"},
    {"rk4_has_no_tolerance", open_loop, "\"event_taylor\"", "\"rk4\"\nstep_s = 1e-8",
     "17:1: solver.tolerance: not used with solver.method = \"rk4\"; remove it"},
    {"open_loop_has_no_actuator_limit", open_loop, "[solver]",
     "max_force_amplitude_N = 1920\n[solver]",
     "14:1: drive.max_force_amplitude_N: not used in open loop, without a [controller] table; "
     "remove it"},
    {"open_loop_has_one_amplitude", open_loop, "[solver]", "interpolation = \"linear\"\n[solver]",
     "14:1: drive.interpolation: not used in open loop, without a [controller] table; remove it"},
    {"linear_under_a_square_wave", closed_loop, "max_force_amplitude_N = 1920.0",
     "max_force_amplitude_N = 1920\nwaveform = \"square\"\ninterpolation = \"linear\"",
     "14:1: drive.interpolation: not used with drive.waveform = \"square\"; remove it"},
    {"codes_that_step", closed_loop, "max_force_amplitude_N = 1920.0",
     "max_force_amplitude_N = 1920\ncodes_per_period = 4",
     "13:1: drive.codes_per_period: not used without drive.interpolation = \"linear\"; remove it"},
    {"three_codes", closed_loop, "max_force_amplitude_N = 1920.0",
     "max_force_amplitude_N = 1920\ninterpolation = \"linear\"\ncodes_per_period = 3",
     "14:20: drive.codes_per_period: 3 does not halve a carrier period; allowed: 1, 2, 4, 8"},
    {"bias_under_a_triangle", closed_loop, "max_force_amplitude_N = 1920.0",
     "max_force_amplitude_N = 1920\nwaveform = \"triangle\"\nbias_limit_N = 3",
     "14:1: drive.bias_limit_N: not used with drive.waveform = \"triangle\"; remove it"},
    {"bias_of_a_mode_too_fast_for_it", closed_loop, "max_force_amplitude_N = 1920.0",
     "max_force_amplitude_N = 1920\nbias_limit_N = 3",
     "13:16: drive.bias_limit_N: is of no use: the natural mode is at 0.221 of the carrier frequency, "
     "and with a delay of 1 carrier periods a bias damps one that is under 0.125; allowed: 0"},
    {"open_loop_has_no_codes", open_loop, "[solver]", "bits = 12\n[solver]",
     "14:1: drive.bits: not used in open loop, without a [controller] table; remove it"},
    {"open_loop_has_no_slew_limit", open_loop, "[solver]", "max_force_slew_N_per_s = 1e6\n[solver]",
     "14:1: drive.max_force_slew_N_per_s: not used in open loop, without a [controller] table; "
     "remove it"},
    {"open_loop_has_no_settling", open_loop, "duration_periods = 20",
     "duration_periods = 20\nsettling_band = 0.01",
     "19:1: run.settling_band: not used in open loop, without a [controller] table; remove it"},
    {"closed_loop_does_not_begin_steady", closed_loop, "duration_s = 1e-3",
     "duration_s = 1e-3\nstart = \"steady\"",
     "15:1: run.start: not used in closed loop, which begins with the drive off; remove it"},
    {"open_loop_has_no_sensor", open_loop, "[run]", "[sensor]\nadc_bits = 12\n[run]",
     "17:2: sensor: not used in open loop, without a [controller] table; remove it"},
    {"open_loop_has_no_model_error", open_loop, "[run]", "[model_error]\n[run]",
     "17:2: model_error: not used in open loop, without a [controller] table; remove it"},
    {"closed_loop_has_no_amplitude", closed_loop, "[run]", "force_amplitude_N = 384\n[run]",
     "13:1: drive.force_amplitude_N: not used in closed loop: the controller sets the amplitude; "
     "remove it"},
    {"coulomb_has_no_contact_stiffness_error", coulomb_closed_loop, "[model_error]",
     "[model_error]\ncontact_stiffness = 1.5",
     "20:1: model_error.contact_stiffness: not used with friction.law = \"coulomb\"; remove it"},
    {"controller_without_friction", closed_loop,
     "law = \"dahl\"\ncoefficient = 0.1\ncontact_stiffness_N_per_m = 0.056e6", "law = \"none\"",
     "13:2: controller: there is no friction to control; allowed: a friction.law other than "
     "\"none\", with coefficient and normal_force_N above 0"},
    {"controller_with_zero_friction", closed_loop, "coefficient = 0.1", "coefficient = 0",
     "15:2: controller: there is no friction to control; allowed: a friction.law other than "
     "\"none\", with coefficient and normal_force_N above 0"},
    {"controller_with_friction_later", closed_loop, "coefficient = 0.1",
     "coefficient_profile = [[0, 0], [1e-3, 0.1]]",
     "15:2: controller: there is no friction to control; allowed: a friction.law other than "
     "\"none\", with coefficient and normal_force_N above 0 at 0 s"},
    {"none_has_no_friction_profile", open_loop,
     "law = \"dahl\"\ncoefficient = 0.1\nnormal_force_N = 0.1962\n"
     "contact_stiffness_N_per_m = 0.056e6",
     "law = \"none\"\ncoefficient_profile = [[0, 1]]",
     "6:1: friction.coefficient_profile: not used with friction.law = \"none\"; remove it"},
    {"interval_without_record", open_loop, "record = [\"displacement_m\"]\n", "",
     "19:21: run.record_interval_s: not used without run.record; remove it"},
    // Keys that exclude each other
    {"velocity_and_profile", open_loop, "[drive]", "profile = [[0, 1]]\n[drive]",
     "11:1: sliding.profile: excludes velocity_m_per_s; allowed: one of the two"},
    {"coefficient_and_profile", open_loop, "coefficient = 0.1",
     "coefficient = 0.1\ncoefficient_profile = [[0, 0.1]]",
     "7:1: friction.coefficient_profile: excludes coefficient; allowed: one of the two"},
    {"normal_force_and_profile", open_loop, "normal_force_N = 0.1962",
     "normal_force_profile_N = [[0, 1]]\nnormal_force_N = 0.1962",
     "8:1: friction.normal_force_N: excludes normal_force_profile_N; allowed: one of the two"},
    {"steady_under_a_friction_profile", moving_open_loop, "duration_periods = 20",
     "duration_periods = 20\nstart = \"steady\"",
     "15:9: run.start: nothing is steady under a friction.normal_force_profile_N; allowed: "
     "\"given\""},
    {"two_durations", open_loop, "duration_periods = 20", "duration_periods = 20\nduration_s = 1",
     "19:1: run.duration_s: excludes duration_periods; allowed: one of the two"},
    {"two_window_starts", open_loop, "duration_periods = 20",
     "duration_periods = 20\nwindow_start_s = 0\nwindow_start_periods = 0",
     "20:1: run.window_start_periods: excludes window_start_s; allowed: one of the two"},
    // Times
    {"periods_without_drive", open_loop,
     "[drive]\nfrequency_Hz = 60e3\nforce_amplitude_N = 384.0\n", "",
     "15:20: run.duration_periods: there is no period without a [drive] table; allowed: the time "
     "in s"},
    {"window_after_end", open_loop, "duration_periods = 20",
     "duration_periods = 20\nwindow_start_periods = 30",
     "19:24: run.window_start_periods: 0.0005 s is not before the end of the run; allowed: at "
     "most 19.9999 periods"},
    {"window_within_the_rounding_of_the_end", open_loop, "duration_periods = 20",
     "duration_periods = 20\nwindow_start_periods = 19.9999999999",
     "19:24: run.window_start_periods: 0.000333333 s is not before the end of the run; allowed: "
     "at most 19.9999 periods"},
    {"zero_duration", closed_loop, "duration_s = 1e-3", "duration_s = 0.0",
     "14:14: run.duration_s: 0 is out of range; allowed: 1e-12 to 1e+09 s"},
    {"shorter_than_a_period", closed_loop, "duration_s = 1e-3", "duration_s = 1e-5",
     "14:14: run.duration_s: 1e-05 s is less than a carrier period, in which the controller acts "
     "once; allowed: at least 1.66667e-05 s"},
    {"too_long", closed_loop, "duration_s = 1e-3", "duration_s = 1e6",
     "14:14: run.duration_s: 1e+06 s is 6e+10 periods of the drive; allowed: at most 166666 "
     "s"},
    {"too_long_for_the_natural_mode", open_loop,
     "[drive]\nfrequency_Hz = 60e3\nforce_amplitude_N = 384.0\n[solver]\nmethod = "
     "\"event_taylor\"\ntolerance = 1e-10\n[run]\nduration_periods = 20",
     "[run]\nduration_s = 1e6",
     "12:14: run.duration_s: 1e+06 s is 1.29787e+10 periods of the natural mode; allowed: at most "
     "770493 s"},
    {"too_many_fixed_steps", open_loop, "\"event_taylor\"\ntolerance = 1e-10",
     "\"rk4\"\nstep_s = 1e-15",
     "18:20: run.duration_periods: 0.000333333 s is 3.33333e+11 steps of solver.step_s; allowed: "
     "at most 6 periods"},
    {"too_many_rows", open_loop, "record_interval_s = 1e-6", "record_interval_s = 1e-13",
     "20:21: run.record_interval_s: gives 3.33333e+09 rows; allowed: at most 1e+09, so at least "
     "3.33334e-13 s"},
    {"unordered_profile", open_loop, "velocity_m_per_s = 0.0267",
     "profile = [[0, 0.1], [2e-3, 0.2], [1e-3, 0.3]]",
     "10:35: sliding.profile[2]: time 0.001 s is not after 0.002 s; allowed: times that increase"},
    {"empty_profile", open_loop, "velocity_m_per_s = 0.0267", "profile = []",
     "10:11: sliding.profile: is empty; allowed: at least one pair [time in s, number]"},
    {"triple_in_profile", open_loop, "velocity_m_per_s = 0.0267", "profile = [[0, 1, 2]]",
     "10:12: sliding.profile[0]: is an array of 3; allowed: a pair [time in s, number]"},
    {"bare_number_in_profile", open_loop, "velocity_m_per_s = 0.0267", "profile = [0, 1]",
     "10:12: sliding.profile[0]: is an integer; allowed: a pair [time in s, number]"},
    {"infinite_in_profile", open_loop, "velocity_m_per_s = 0.0267", "profile = [[0, 1], [1, inf]]",
     "10:24: sliding.profile[1][1]: is not finite; allowed: a number, -1e+06 to 1e+06 m/s"},
    {"negative_in_friction_profile", open_loop, "coefficient = 0.1",
     "coefficient_profile = [[0, 0.1], [1e-3, -0.1]]",
     "6:41: friction.coefficient_profile[1][1]: -0.1 is out of range; allowed: 0 to 100"},
    {"falling_time_in_friction_profile", open_loop, "coefficient = 0.1",
     "coefficient_profile = [[2e-3, 0.1], [1e-3, 0.2]]",
     "6:37: friction.coefficient_profile[1]: time 0.001 s is before 0.002 s; allowed: times that "
     "increase, or two of one time for a jump"},
    {"third_row_of_a_jump", open_loop, "normal_force_N = 0.1962",
     "normal_force_profile_N = [[0, 1], [0, 2], [0, 3]]",
     "7:43: friction.normal_force_profile_N[2]: is the third pair of time 0 s; allowed: at most "
     "two, for a jump"},
    {"bristles_without_a_limit", open_loop, "law = \"dahl\"\ncoefficient = 0.1",
     "law = \"lugre\"\nstatic_coefficient = 0.2\nstribeck_velocity_m_per_s = 0.1\n"
     "coefficient_profile = [[0, 0]]",
     "8:28: friction.coefficient_profile[0][1]: 0 is out of range; allowed: above 0, at most 100"},
    {"static_coefficient_below_a_profile", open_loop, "law = \"dahl\"\ncoefficient = 0.1",
     "law = \"lugre\"\nstatic_coefficient = 0.15\nstribeck_velocity_m_per_s = 0.1\n"
     "coefficient_profile = [[0, 0.1], [1, 0.2]]",
     "6:22: friction.static_coefficient: 0.15 is out of range; allowed: 0.2 to 100"},
    {"curve_below_zero_on_a_profile", open_loop, "law = \"dahl\"\ncoefficient = 0.1",
     "law = \"stribeck\"\nfall_s_per_m = 1.5\nrise_s3_per_m3 = 50\n"
     "coefficient_profile = [[0, 0.2], [1, 0.05]]",
     "7:18: friction.rise_s3_per_m3: 50 lets the friction fall below zero; allowed: at least 200 "
     "s^3/m^3 with this fall_s_per_m"},
    {"first_target_late", closed_loop, "[[0.0, 0.4], ", "[[1e-4, 0.4], ",
     "17:25: controller.target_friction_ratio: begins at 0.0001 s; allowed: a first time of 0 s"},
    {"repeated_target_time", closed_loop, "[0.5e-3, 0.6]", "[0.0, 0.6]",
     "17:38: controller.target_friction_ratio[1]: time 0 s is not after 0 s; allowed: times that "
     "increase"},
    {"target_zero", closed_loop, "[0.5e-3, 0.6]", "[0.5e-3, 0]",
     "17:47: controller.target_friction_ratio[1][1]: 0 is out of range; allowed: above 0, at most "
     "1"},
    {"target_above_one", closed_loop, "[[0.0, 0.4]", "[[0.0, 1.1]",
     "17:32: controller.target_friction_ratio[0][1]: 1.1 is out of range; allowed: above 0, at "
     "most 1"},
    {"calibration_past_the_end", closed_loop, "arithmetic", "calibration_s = 1e-3\narithmetic",
     "16:17: controller.calibration_s: 0.001 s is not before the end of the run; allowed: less "
     "than 0.001 s"},
    // Text that is not TOML
    {"duplicate_key", open_loop, "mass_kg = 0.02", "mass_kg = 0.02\nmass_kg = 0.03",
     "3:11: toml: key-value pair: cannot redefine existing floating-point "
     "'mass_kg'; allowed: TOML 1.0, in UTF-8"},
    {"duplicate_table", open_loop, "[friction]", "[plant]",
     "4:1: toml: table header: cannot redefine existing table 'plant'; allowed: TOML 1.0, in "
     "UTF-8"},
    {"decimal_comma", open_loop, "0.02", "0,02",
     "2:12: toml: key-value pair: expected a comment or whitespace, saw ','; allowed: TOML 1.0, in "
     "UTF-8"},
    {"not_utf_8", open_loop, "\"dahl\"", "\"dahl\xff\"",
     "5:11: toml: Encountered invalid utf-8 sequence; allowed: TOML 1.0, in UTF-8"},
    {"truncated", open_loop, "record_interval_s = 1e-6\n", "record_interval_s = ",
     "20:21: toml: key-value pair: encountered end-of-file; allowed: TOML 1.0, in UTF-8"},
    {"unclosed_header", open_loop, "[plant]", "[plant",
     "1:7: toml: table header: expected ']', saw '\\n'; allowed: TOML 1.0, in UTF-8"},
};

class BrokenSceneTest : public testing::TestWithParam<BrokenScene> {};

TEST_P(BrokenSceneTest, IsRejectedInOneLineAndLeavesNothing) {
  const ScratchFolder folder;
  folder.write("broken.toml", edited(GetParam()));
  const Outcome outcome = folder.run("run broken.toml");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, std::string("broken.toml:") + GetParam().error + "\n");
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(folder.entries(), std::vector<std::string>{"broken.toml"});
}

INSTANTIATE_TEST_SUITE_P(Table, BrokenSceneTest, testing::ValuesIn(broken_scenes),
                         [](const auto& scene) { return std::string(scene.param.name); });

TEST(UneditedSceneTest, IsAccepted) {
  for (const std::string& text : {open_loop, closed_loop}) {
    const ScratchFolder folder;
    folder.write("good.toml", text);
    const Outcome outcome = folder.run("run good.toml --quiet");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
  }
}

}  // namespace
}  // namespace sonoglide::acceptance::broken_scenes_test
