#include "tests/random_loops/loops/random_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "firmware/numeric/float_sqrt.hpp"
#include "firmware/numeric/turn.hpp"
#include "tests/random_loops/loops/dice.hpp"

namespace sonoglide::random_loops {
namespace {

constexpr double standard_gravity_m_per_s2 = 9.81;

struct Share {
  std::string_view name;
  double percent;
};

constexpr std::array<Share, 7> laws = {{{"dahl", 55.0},
                                        {"coulomb", 20.0},
                                        {"lugre", 5.0},
                                        {"iwan", 5.0},
                                        {"stribeck", 5.0},
                                        {"transverse_coulomb", 5.0},
                                        {"normal_coulomb", 5.0}}};
constexpr std::array<Share, 4> arithmetics = {
    {{"float32", 35.0}, {"q31", 30.0}, {"q15", 20.0}, {"float64", 15.0}}};

template <std::size_t Count>
std::string_view draw_name(Dice& dice, const std::array<Share, Count>& shares) {
  std::array<double, Count> percentages{};
  std::transform(shares.begin(), shares.end(), percentages.begin(),
                 [](const Share& share) { return share.percent; });
  return shares[dice.part(percentages)].name;
}

/// Natural over carrier frequency.
double draw_mode(Dice& dice) {
  constexpr std::array<double, mode_count> percentages = {45.0, 35.0, 5.0, 15.0};
  switch (static_cast<Mode>(dice.part(percentages))) {
    case Mode::below:
      return dice.between(0.05, 0.92);
    case Mode::above:
      return dice.between(1.075, 3.6);
    case Mode::near_zero:
      return dice.over_decades(1e-3, 1.6);  // to 0.04
    case Mode::near_multiple:
      break;
  }
  const int multiple = dice.whole(2, 4);
  return multiple + dice.sign() * dice.over_decades(1e-4, 2.6);  // to 0.04
}

Mode mode_class(double mode_per_carrier) {
  if (std::abs(mode_per_carrier - std::round(mode_per_carrier)) > near_multiple) {
    return mode_per_carrier < 1.0 ? Mode::below : Mode::above;
  }
  return mode_per_carrier < 1.0 ? Mode::near_zero : Mode::near_multiple;
}

double draw_damping_ratio(Dice& dice) {
  constexpr std::array<double, 3> percentages = {50.0, 25.0, 25.0};
  switch (dice.part(percentages)) {
    case 0:
      return 0.0;
    case 1:
      return dice.over_decades(1e-4, 2.0);
    default:
      return dice.over_decades(1e-2, 1.477);
  }
}

double angular_frequency_rad_per_s(const RandomLoop& loop) {
  return numeric::two_pi * loop.frequency_Hz;
}

double full_vibration_m_per_s(const RandomLoop& loop) {
  return loop.full_velocity_ratio * std::abs(loop.sliding_velocity_m_per_s);
}

double full_vibration_m(const RandomLoop& loop) {
  return full_vibration_m_per_s(loop) / angular_frequency_rad_per_s(loop);
}

double friction_N(const RandomLoop& loop) {
  return loop.coefficient * loop.normal_force_N;
}

void draw_plant(Dice& dice, RandomLoop& loop) {
  loop.mass_kg = dice.over_decades(1e-3, 3.0);
  loop.frequency_Hz = dice.over_decades(18e3, 0.8239);  // to 120 kHz
  loop.mode_per_carrier = draw_mode(dice);
  loop.mode = mode_class(loop.mode_per_carrier);
  loop.damping_ratio = draw_damping_ratio(dice);
  const double natural_rad_per_s = loop.mode_per_carrier * angular_frequency_rad_per_s(loop);
  loop.stiffness_N_per_m = loop.mass_kg * natural_rad_per_s * natural_rad_per_s;
  loop.damping_N_s_per_m = 2.0 * loop.damping_ratio * loop.mass_kg * natural_rad_per_s;
}

void draw_sliding_and_drive(Dice& dice, RandomLoop& loop) {
  loop.sliding_velocity_m_per_s = dice.sign() * dice.over_decades(1e-3, 2.477);
  loop.full_velocity_ratio =
      dice.chance(1.0 / 12.0) ? dice.between(1.1, 3.0) : dice.over_decades(3.0, 0.602);
  const double omega = angular_frequency_rad_per_s(loop);
  const double reactive = loop.stiffness_N_per_m - loop.mass_kg * omega * omega;
  const double resistive = loop.damping_N_s_per_m * omega;
  loop.max_force_amplitude_N =
      full_vibration_m(loop) * numeric::sqrt(reactive * reactive + resistive * resistive);
}

/// A line of a scene. Six digits are enough to be what was drawn, and short enough to be read.
std::string line(std::string_view key, double value) {
  return fmt::format("{} = {:.6g}\n", key, value);
}
std::string line_unless_zero(std::string_view key, double value) {
  return value == 0.0 ? "" : line(key, value);
}

void draw_lugre(Dice& dice, RandomLoop& loop) {
  const double friction_per_velocity = friction_N(loop) / full_vibration_m_per_s(loop);
  loop.law_keys = line("static_coefficient", loop.coefficient * dice.between(1.0, 1.5));
  loop.law_keys += line("stribeck_velocity_m_per_s",
                        std::abs(loop.sliding_velocity_m_per_s) * dice.over_decades(0.3, 1.0));
  loop.law_keys +=
      line("bristle_damping_N_s_per_m", friction_per_velocity * dice.between(0.0, 0.1));
  loop.law_keys +=
      line("viscous_friction_N_s_per_m", friction_per_velocity * dice.between(0.0, 0.2));
}

/// The curve falls by up to a quarter from rest to the sliding speed, and never below zero.
void draw_stribeck(Dice& dice, RandomLoop& loop) {
  const double fall_s_per_m =
      dice.between(0.0, 0.25) * loop.coefficient / std::abs(loop.sliding_velocity_m_per_s);
  const double least = 4.0 * fall_s_per_m * fall_s_per_m * fall_s_per_m /
                       (27.0 * loop.coefficient * loop.coefficient);
  loop.law_keys = line("fall_s_per_m", fall_s_per_m);
  loop.law_keys += line("rise_s3_per_m3", least * dice.between(1.01, 2.0));
}

/// Full drive takes 0.5 to 1.2 of the normal force away; the sliding is 0.05 to 0.5 of the speed
/// from which nothing is lost.
void draw_normal_coulomb(Dice& dice, RandomLoop& loop) {
  const double normal_N_per_m =
      dice.between(0.5, 1.2) * loop.normal_force_N / full_vibration_m(loop);
  loop.law_keys = line("normal_contact_stiffness_N_per_m", normal_N_per_m);
  loop.contact_stiffness_N_per_m =
      dice.over_decades(0.05, 1.0) * loop.coefficient * normal_N_per_m * loop.full_velocity_ratio;
  loop.full_dahl_number =
      loop.contact_stiffness_N_per_m * full_vibration_m(loop) / friction_N(loop);
}

void draw_contact_stiffness(Dice& dice, RandomLoop& loop) {
  loop.full_dahl_number = dice.over_decades(0.05, 3.301);  // to 100
  loop.contact_stiffness_N_per_m =
      loop.full_dahl_number * friction_N(loop) / full_vibration_m(loop);
}

void draw_friction(Dice& dice, RandomLoop& loop) {
  loop.law = draw_name(dice, laws);
  loop.coefficient = dice.over_decades(0.05, 1.0);
  const double weight_N = loop.mass_kg * standard_gravity_m_per_s2;
  loop.normal_force_N = dice.chance(0.5) ? weight_N : weight_N * dice.over_decades(1.0, 2.0);
  const double natural_rad_per_s = loop.mode_per_carrier * angular_frequency_rad_per_s(loop);
  loop.friction_ringing = friction_N(loop) / (loop.mass_kg * natural_rad_per_s *
                                              std::abs(loop.sliding_velocity_m_per_s));
  if (loop.law == "normal_coulomb") {
    draw_normal_coulomb(dice, loop);
  } else if (loop.law == "stribeck") {
    draw_stribeck(dice, loop);
  } else if (loop.law == "dahl" || loop.law == "lugre" || loop.law == "iwan") {
    draw_contact_stiffness(dice, loop);
  }
  if (loop.law == "lugre") {
    draw_lugre(dice, loop);
  } else if (loop.law == "iwan") {
    loop.law_keys = line("elements", dice.whole(1, 8));
  }
}

void draw_sensor(Dice& dice, RandomLoop& loop) {
  if (dice.chance(0.3)) {
    return;
  }
  SensorNumbers& sensor = loop.sensor;
  if (dice.chance(0.6)) {
    sensor.adc_bits = dice.whole(8, 16);
  }
  if (dice.chance(0.5)) {
    sensor.force_noise_N = friction_N(loop) * dice.over_decades(1e-4, 1.7);  // to 0.5 %
  }
  if (dice.chance(0.5)) {
    sensor.force_bandwidth_Hz = dice.over_decades(2e3, 1.398);  // to 50 kHz
  }
  if (dice.chance(0.5)) {
    sensor.delay_periods = dice.whole(1, 4);
  }
}

bool has_contact_stiffness(const RandomLoop& loop) {
  return loop.contact_stiffness_N_per_m > 0.0;
}

/// That the sliding takes through the contact's presliding travel.
double presliding_s(const RandomLoop& loop) {
  return has_contact_stiffness(loop) ? friction_N(loop) / loop.contact_stiffness_N_per_m /
                                           std::abs(loop.sliding_velocity_m_per_s)
                                     : 0.0;
}

/// Long enough for contact and sensor to settle.
double draw_calibration_s(Dice& dice, const RandomLoop& loop) {
  if (dice.chance(0.25)) {
    return 0.0;
  }
  const double filter_s = loop.sensor.force_bandwidth_Hz
                              ? 1.0 / (numeric::two_pi * *loop.sensor.force_bandwidth_Hz)
                              : 0.0;
  const double settling_s = 15.0 * presliding_s(loop) + 6.0 * filter_s;
  constexpr double more_periods = 20.0;
  return dice.between(1.0, 3.0) * (settling_s + more_periods / loop.frequency_Hz);
}

void draw_controller(Dice& dice, RandomLoop& loop) {
  loop.arithmetic = draw_name(dice, arithmetics);
  loop.calibration_s = draw_calibration_s(dice, loop);
  for (std::size_t i = 0; i < steps_per_loop; ++i) {
    loop.step_s[i] = dice.between(2e-3, 4e-3) + 7.0 * presliding_s(loop);
    loop.targets[i] = dice.between(0.25, 0.9);
  }
}

void draw_model_error(Dice& dice, RandomLoop& loop) {
  if (loop.index % 2 == 0) {
    return;
  }
  ModelErrorNumbers error;
  error.stiffness = dice.between(0.95, 1.05);
  error.coefficient = dice.between(0.7, 1.3);
  error.contact_stiffness = dice.between(0.5, 1.5);
  loop.model_error = error;
}

double nominal_mode_per_carrier(const RandomLoop& loop) {
  return loop.mode_per_carrier * (loop.model_error ? std::sqrt(loop.model_error->stiffness) : 1.0);
}

bool biased(const RandomLoop& loop, Vibration vibration) {
  switch (vibration) {
    case Vibration::sensorless_biased:  // a sensorless loop does not tell the slowest ones
      return configure::told_mode < loop.mode_per_carrier &&
             loop.mode_per_carrier < configure::slow_mode;
    case Vibration::damped_biased:
      return loop.mode_per_carrier < configure::slow_mode;
    case Vibration::all_means:
      return means_for(loop).biased;
    default:
      return false;
  }
}

/// A bias limit of about what design recommends, for a slow mode; and how the drive passes.
std::string drive_text(const RandomLoop& loop, Vibration vibration) {
  std::string text = "[drive]\n" + line("frequency_Hz", loop.frequency_Hz) +
                     line("max_force_amplitude_N", loop.max_force_amplitude_N);
  if (biased(loop, vibration)) {
    text += line("bias_limit_N", 2.0 * friction_N(loop) +
                                     0.056 * loop.mode_per_carrier * loop.max_force_amplitude_N);
  }
  if (vibration == Vibration::all_means && means_for(loop).ramped()) {
    text +=
        "interpolation = \"linear\"\n" + line("codes_per_period", means_for(loop).codes_per_period);
  }
  return text;
}

bool observes(const RandomLoop& loop, Vibration vibration) {
  return vibration == Vibration::all_means ? means_for(loop).sensorless
                                           : vibration != Vibration::unseen;
}

std::string controller_text(const RandomLoop& loop, Vibration vibration) {
  std::string targets;
  double begin_s = 0.0;
  for (std::size_t i = 0; i < steps_per_loop; ++i) {
    targets += fmt::format("{}[{:.6g}, {:.6g}]", i == 0 ? "" : ", ", begin_s, loop.targets[i]);
    begin_s += loop.step_s[i] + (i == 0 ? loop.calibration_s : 0.0);
  }
  const bool damped = observes(loop, vibration);
  const bool finer = damped || vibration == Vibration::all_means;
  std::string means = damped ? "vibration = \"damped\"\n" : "";
  if (vibration == Vibration::all_means && means_for(loop).shaping_range > 0.0) {
    means += "shaping = \"robust\"\n" + line("shaping_range", means_for(loop).shaping_range);
  }
  const bool calibrates = vibration != Vibration::damped_alone;
  return fmt::format(R"([run]
duration_s = {:.6g}
[controller]
arithmetic = "{}"
{}target_friction_ratio = [{}]
{})",
                     begin_s, finer && loop.arithmetic == "q15" ? "q31" : loop.arithmetic, means,
                     targets,
                     line_unless_zero("calibration_s", calibrates ? loop.calibration_s : 0.0));
}

std::string sensor_text(const RandomLoop& loop, Vibration vibration) {
  const SensorNumbers& sensor = loop.sensor;
  const bool damped = vibration == Vibration::damped || vibration == Vibration::damped_alone ||
                      vibration == Vibration::damped_biased;
  if (sensor.ideal() && !damped) {
    return "";
  }
  std::string text = "[sensor]\n";
  if (damped) {
    text += "vibration = \"velocity\"\nvibration_bits = 14\n";
  }
  if (vibration == Vibration::damped_alone) {
    return text + "force = false\n";
  }
  return text + line_unless_zero("adc_bits", sensor.adc_bits.value_or(0)) +
         line_unless_zero("force_noise_N", sensor.force_noise_N) +
         line_unless_zero("force_bandwidth_Hz", sensor.force_bandwidth_Hz.value_or(0.0)) +
         line_unless_zero("delay_periods", sensor.delay_periods) +
         fmt::format("seed = {}\n", loop.index);
}

std::string model_error_text(const RandomLoop& loop) {
  if (!loop.model_error) {
    return "";
  }
  const ModelErrorNumbers& error = *loop.model_error;
  return "[model_error]\n" + line("stiffness", error.stiffness) +
         line("coefficient", error.coefficient) +
         (has_contact_stiffness(loop) ? line("contact_stiffness", error.contact_stiffness) : "");
}

/// By how much the mode turns otherwise than believed in a carrier period.
double turn_error_rad(const RandomLoop& loop) {
  const double nominal = loop.model_error ? std::sqrt(loop.model_error->stiffness) : 1.0;
  return numeric::two_pi * loop.mode_per_carrier * std::abs(nominal - 1.0);
}

}  // namespace

double beside_multiple(const RandomLoop& loop) {
  const double nearest = std::round(loop.mode_per_carrier);
  return nearest < 2.0 ? std::numeric_limits<double>::infinity()
                       : std::abs(loop.mode_per_carrier - nearest);
}

configure::RecommendedMeans means_for(const RandomLoop& loop) {
  const bool along = loop.law != "transverse_coulomb" && loop.law != "normal_coulomb";
  return configure::recommended_means(nominal_mode_per_carrier(loop), along);
}

Cause cause_of(const RandomLoop& loop) {
  constexpr double beside = 0.13;
  constexpr double slow_s = 0.5e-3;
  constexpr double forgets = 4.6 / 1.3;  // presliding times until 1 % is left, under vibration
  constexpr double noisy = 2e-3;
  constexpr double far_rad = 0.3;
  const double nearest = std::round(loop.mode_per_carrier);
  const bool near = nearest != 1.0 && std::abs(loop.mode_per_carrier - nearest) < beside;
  const SensorNumbers& sensor = loop.sensor;
  if (loop.model_error && loop.calibration_s == 0.0) {
    return Cause::trusted_friction;
  }
  if (near) {
    return Cause::multiple;
  }
  if (forgets * presliding_s(loop) > slow_s) {
    return Cause::slow_contact;
  }
  if (sensor.adc_bits.value_or(32) <= 9 || sensor.force_bandwidth_Hz.value_or(1e9) < 5e3 ||
      sensor.force_noise_N >= noisy * friction_N(loop)) {
    return Cause::coarse_sensor;
  }
  return turn_error_rad(loop) < far_rad ? Cause::none : Cause::far_stiffness;
}

RandomLoop random_loop(std::uint32_t seed, std::uint32_t index) {
  Dice dice(seed, index);
  RandomLoop loop;
  loop.index = index;
  draw_plant(dice, loop);
  draw_sliding_and_drive(dice, loop);
  draw_friction(dice, loop);
  draw_sensor(dice, loop);
  draw_controller(dice, loop);
  draw_model_error(dice, loop);
  return loop;
}

std::string scene_text(const RandomLoop& loop, Vibration vibration) {
  const std::string plant = fmt::format(
      R"([plant]
mass_kg = {:.6g}
stiffness_N_per_m = {:.6g}
{}[friction]
law = "{}"
coefficient = {:.6g}
normal_force_N = {:.6g}
{}{}[sliding]
velocity_m_per_s = {:.6g}
)",
      loop.mass_kg, loop.stiffness_N_per_m,
      line_unless_zero("damping_N_s_per_m", loop.damping_N_s_per_m), loop.law, loop.coefficient,
      loop.normal_force_N,
      line_unless_zero("contact_stiffness_N_per_m", loop.contact_stiffness_N_per_m), loop.law_keys,
      loop.sliding_velocity_m_per_s);
  return plant + drive_text(loop, vibration) + "[solver]\ntolerance = 1e-08\n" +
         controller_text(loop, vibration) + sensor_text(loop, vibration) + model_error_text(loop);
}

}  // namespace sonoglide::random_loops
