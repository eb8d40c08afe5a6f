/// Closed loops drawn over what a controller may be asked to serve.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "host_sim/configure/vibration/recommended_means.hpp"

namespace sonoglide::random_loops {

/// Where the natural frequency lies, seen from the carrier's.
enum class Mode { below, above, near_zero, near_multiple };
inline constexpr std::size_t mode_count = 4;
inline constexpr std::array<std::string_view, mode_count> mode_names = {
    "below carrier", "above carrier", "near zero", "near multiple"};

/// A mode within this part of the carrier of zero or of a multiple (none comes near the carrier
/// itself) is in a class of its own: a notch on it is ill-conditioned or banned. One near zero is
/// of a spring so soft that friction drags the mass along.
inline constexpr double near_multiple = 0.04;

inline constexpr std::size_t steps_per_loop = 3;

struct SensorNumbers {
  std::optional<int> adc_bits;
  double force_noise_N = 0.0;
  std::optional<double> force_bandwidth_Hz;
  int delay_periods = 0;

  bool ideal() const {
    return !adc_bits && force_noise_N == 0.0 && !force_bandwidth_Hz && delay_periods == 0;
  }
};

struct ModelErrorNumbers {
  double stiffness = 1.0;
  double coefficient = 1.0;
  double contact_stiffness = 1.0;
};

/// A closed loop in the numbers that it was drawn by, and in those of its scene.
struct RandomLoop {
  std::uint32_t index = 0;
  Mode mode = Mode::below;
  double mode_per_carrier = 0.0;     ///< natural over carrier frequency
  double damping_ratio = 0.0;        ///< of critical
  double full_velocity_ratio = 0.0;  ///< peak vibration velocity at full drive over the sliding's
  double full_dahl_number = 0.0;     ///< Kt X/Fc at full drive, elastic laws
  double friction_ringing =
      0.0;  ///< Fc/(m omega_n), of the mode where Fc sets in, over the sliding

  std::string_view law;
  std::string_view arithmetic;
  double mass_kg = 0.0;
  double stiffness_N_per_m = 0.0;
  double damping_N_s_per_m = 0.0;
  double coefficient = 0.0;
  double normal_force_N = 0.0;
  double contact_stiffness_N_per_m = 0.0;
  std::string law_keys;  ///< what the law has beyond the contact, as lines of [friction]
  double sliding_velocity_m_per_s = 0.0;
  double frequency_Hz = 0.0;
  double max_force_amplitude_N = 0.0;
  double calibration_s = 0.0;
  std::array<double, steps_per_loop> step_s{};  ///< how long each target holds
  std::array<double, steps_per_loop> targets{};
  SensorNumbers sensor;
  std::optional<ModelErrorNumbers> model_error;
};

/// Loop number `index` of a seed: the same on every machine, whatever was drawn before.
///
/// Mass 1 g to 1 kg, carrier 18 to 120 kHz, sliding 1 mm/s to 0.3 m/s either way, normal force 1 to
/// 100 times the weight, all log-uniform; natural frequency 0.05 to 0.92 of the carrier, 1.075 to
/// 3.6 of it, 1e-3 to 0.04, or 1e-4 to 0.04 beside its second to fourth multiple; damping none,
/// 1e-4 to 0.01, or 0.01 to 0.3 of critical. Full drive vibrates 3 to 12 times as fast as the
/// sliding, in one of twelve 1.1 to 3 times; the Dahl number is 0.05 to 100 there. Three targets
/// from 0.25 to 0.9 hold 2 to 4 ms each, and as long as the undriven contact takes to forget; three
/// of four controllers learn the friction force first. Every other loop has a controller that is
/// wrong by up to 5 % in stiffness, 30 % in friction and 50 % in contact stiffness.
RandomLoop random_loop(std::uint32_t seed, std::uint32_t index);

/// Distance of the mode from the nearest multiple of the carrier, from the second on, in carrier
/// frequencies; infinite where none is nearest.
double beside_multiple(const RandomLoop& loop);

/// What is most likely to keep a loop from its targets, by what was drawn alone: the first of these that
/// holds. A step that is out of the drive's reach is counted beside that.
enum class Cause {
  trusted_friction,  ///< believed wrong, and never learnt
  multiple,          ///< the mode is within 0.13 of the carrier of zero or of a multiple
  slow_contact,      ///< the contact takes half a millisecond or more to forget
  coarse_sensor,     ///< 8 or 9 bits, below 5 kHz, or noise of 0.2 % of the friction or more
  far_stiffness,     ///< the mode turns by 0.3 rad or more otherwise than believed in a period
  none
};
inline constexpr std::array<std::string_view, 6> cause_names = {
    "friction trusted but wrong", "mode next to a multiple",        "slow contact",
    "coarse or slow sensor",      "stiffness far off for the mode", "none of these"};
Cause cause_of(const RandomLoop& loop);

/// What a loop knows of its vibration.
enum class Vibration {
  unseen,      ///< the drive is fed forward
  sensorless,  ///< controller.vibration = "damped", felt in the friction; q31 in place of q15
  /// The same, seen by a pick-up of 14 bits.
  damped,
  damped_alone,       ///< the same without a force sensor
  sensorless_biased,  ///< as sensorless, with a bias against a mode below configure::slow_mode
  damped_biased,      ///< likewise as damped
  all_means,          ///< with the force sensor alone, what suits the nominal mode, see means_for()
};

/// What a loop with all means has: what sonoglide design recommends for its nominal mode and its law.
configure::RecommendedMeans means_for(const RandomLoop& loop);

/// Its scene, TOML that the program reads.
std::string scene_text(const RandomLoop& loop, Vibration vibration = Vibration::unseen);

}  // namespace sonoglide::random_loops
