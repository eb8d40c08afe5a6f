#include "host_sim/configure/control_design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/control/controller.hpp"
#include "firmware/control/friction_level.hpp"
#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/believed_plant.hpp"
#include "host_sim/configure/bound.hpp"
#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/design_periods.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/scene/names.hpp"

namespace sonoglide::configure {
namespace {

// The elementary functions are the core's own, so that a scene gives the same parameters, bit for
// bit, on every machine.

/// The controller's resolution ends here, per unit.
constexpr double smallest_friction = control::FrictionLevel<double>::smallest();

/// How far the natural frequency may be off; 0 where the scene takes it as known, or has no notch.
double shaping_range(const scene::Scene& scene) {
  return scene.controller->shaping == scene::Shaping::robust
             ? scene.controller->shaping_range.value_or(default_shaping_range(scene.tolerances))
             : 0.0;
}

void design_shaper(const scene::Scene& scene, const NaturalMode& mode, ControlDesign& design) {
  design.shaping_range = shaping_range(scene);
  if (scene.controller->shaping != scene::Shaping::none) {
    design.notch = design.shaping_range > 0.0 ? design_robust_notch(mode, design.shaping_range)
                                              : design_notch(mode);
  }
}

/// Force of one code of the converter; 0 of an ideal one.
double code_N(const scene::Sensor& sensor) {
  return sensor.adc_bits ? 2.0 * sensor.force_full_scale_N * std::exp2(-*sensor.adc_bits) : 0.0;
}

/// A natural mode that nothing notches out answers every change of the command, and feedback drives
/// it further: by less than its own damping takes away, if the gain is small against that. Without
/// damping there is no such gain, and feedforward is left alone. A scene that leaves the notch out
/// on purpose gets slow feedback all the same, to show what becomes of it.
double gain_beside_free_mode(const scene::Scene& scene, const NaturalMode& mode) {
  constexpr double slow = 0.005;
  constexpr double part_of_decay = 0.2;
  return scene.controller->shaping == scene::Shaping::none
             ? slow
             : std::min(slow, part_of_decay * (1.0 - mode.decay));
}

/// Feedback drives what a notch leaves of the free mode, to grow or to decay as the delays of the
/// loop have it, and at a rate below a quarter of gain times ripple per carrier period (an eighth
/// was seen at Table 1, at the worst of several delays).
double missing_damping_N_s_per_m(const NotchDesign& notch, const NaturalMode& mode, double mass_kg,
                                 const ControlDesign& design) {
  const double growth = 0.25 * design.integral_gain * notch.ripple;
  return growth > 1.0 - mode.decay ? 2.0 * mass_kg * growth / design.scales.carrier_period_s : 0.0;
}

/// An integrator behind a delay of D periods oscillates at a gain of 2 sin(π/(4D+2)); a third of it
/// leaves room for a contact twice as steep as believed.
double gain_behind_delay(double periods) {
  return std::min(0.25, 2.0 / 3.0 * numeric::sin(numeric::two_pi / (8.0 * periods + 4.0)));
}

/// How long the integral waits for a changed target, and then does not.
void set_waiting(double delay, double filter, ControlDesign& design) {
  constexpr double contact_settling = 2.0;  // carrier periods until the contact has forgotten
  constexpr double filter_settling = 4.0;   // time constants more: 0.7 % of a step is left
  constexpr double rest_per_hold = 1.25;    // in which feedback acts
  design.hold_periods = whole_periods(delay + contact_settling + filter_settling * filter);
  design.rest_periods = whole_periods(rest_per_hold * design.hold_periods);
}

void design_regulator(const scene::Scene& scene, const NaturalMode& mode, double mass_kg,
                      ControlDesign& design) {
  const double filter = filter_periods(scene, design.scales);
  const double shaping = design.notch_span();
  // From a command to the reading that shows it.
  const double latency = latency_periods(scene);
  const double delay = latency + shaping + filter;
  const double behind_delay = gain_behind_delay(delay);
  design.free_mode = mode.rotation > 0.0 && !design.notch;
  design.integral_gain =
      design.free_mode ? std::min(behind_delay, gain_beside_free_mode(scene, mode)) : behind_delay;
  if (design.notch) {
    design.missing_damping_N_s_per_m =
        missing_damping_N_s_per_m(*design.notch, mode, mass_kg, design);
  }
  set_waiting(delay, filter, design);
  design.reference_delay_periods = static_cast<std::uint8_t>(latency + 0.5 * design.notch_span());
  design.reference_keep = filter / (1.0 + filter);
  design.lead_periods = 0.5 + 0.5 * design.notch_span() + scene.drive->delay_periods;
}

/// The inner loop follows a small change of its velocity within a few periods; while it follows a
/// large one the integral waits.
void design_outer_regulator(const scene::Scene& scene, ControlDesign& design) {
  const double following = scene.resonant() ? 3.0 : 6.0;
  const double filter = filter_periods(scene, design.scales);
  const double latency = latency_periods(scene);
  design.integral_gain = gain_behind_delay(latency + following + filter);
  set_waiting(latency + following, filter, design);
  design.reference_delay_periods = static_cast<std::uint8_t>(latency);
  design.reference_keep = (filter + 1.0) / (filter + 2.0);
  design.lead_periods = 1.5 + scene.drive->delay_periods;
}

/// Until a change of the request has become one of the vibration: through the notch, until the
/// natural mode is quiet, or at resonance as fast as full drive builds it up.
double changing_periods(const ControlDesign& design) {
  constexpr double quieting = 16.0;
  if (!design.resonance) {
    return design.damping || design.feeling ? quieting : design.notch_span();
  }
  constexpr double latency = 8.0;
  const double head_room = std::max(1.01, design.resonance->head_room);
  const double constants = -numeric::log2(1.0 - 1.0 / head_room) * 0.69314718055994531;
  return latency + constants * 2.0 * design.resonance->quality_factor / numeric::two_pi;
}

/// What the controller is to notice, and after how long.
void design_supervision(const scene::Scene& scene, const BelievedPlant& plant,
                        ControlDesign& design) {
  const double filter = filter_periods(scene, design.scales);
  const double delay = latency_periods(scene) + design.notch_span() + filter;
  constexpr double filter_settling = 4.0;
  constexpr double stuck_margin = 8.0;
  // Normal vibration may leave the ratio where it is, whatever the drive.
  const bool supervised = scene::vibration_of(scene.friction.law) != friction::Vibration::normal;
  design.stuck_periods =
      supervised ? whole_periods(delay + filter_settling * filter + stuck_margin) : 0;
  constexpr double implausible_margin = 16.0;
  // A friction that has jumped shows in full while a pause takes the vibration away.
  const double pause = design.relearns ? 2.0 * changing_periods(design) : 0.0;
  design.implausible_periods = whole_periods(design.hold_periods + implausible_margin + pause);

  constexpr double fall_periods = 128.0;
  design.standstill_hold_periods = static_cast<std::uint32_t>(std::min(
      4e9, std::round(scene.controller->standstill_hold_s / design.scales.carrier_period_s)));
  design.standstill_fall = 1.0 / fall_periods;

  constexpr double noise_deviations = 4.0;
  constexpr double widest_band = 0.5;
  const double reading =
      (noise_deviations * scene.sensor.force_noise_N + code_N(scene.sensor)) / plant.friction_N;
  design.settling_band = 0.5 * std::min(widest_band, scene.run.settling_band + reading);
  constexpr double holds = 4.0;
  constexpr double patience_margin = 40.0;
  // Twice the quality factor in periods is six time constants of a resonance.
  const double building_up = design.resonance ? 2.0 * design.resonance->quality_factor : 0.0;
  design.settling_patience_periods =
      whole_periods(holds * design.hold_periods + patience_margin + building_up);
  const bool tells = tells_mismatch(scene) && (!design.feeling || design.feeling->apart);
  design.agreement = tells ? 1.0 / scene.controller->mismatch_warning : 0.0;
}

/// value/scale, or an error in the name of the key that one should change.
/// @param finding  what is wrong, with a place for the ratio
/// @param allowed  in the unit of the key
double per_unit(double value, double scale, double smallest, const char* key,
                const std::string& finding, const std::string& allowed) {
  const double ratio = value / scale;
  if (!(ratio >= smallest && ratio < 1.0)) {
    throw ConfigurationError(key,
                             fmt::format(fmt::runtime(finding), ratio) + "; allowed: " + allowed);
  }
  return ratio;
}

double presliding_m(const BelievedPlant& plant) {
  return plant.contact_stiffness_N_per_m > 0.0 ? plant.friction_N / plant.contact_stiffness_N_per_m
                                               : 0.0;
}

/// Slowest sliding at which the friction ratio is taken as defined by its steady map: the contact's
/// presliding travel takes at most three carrier periods, so that it forgets faster than a speed is
/// likely to change. Never more than half of the fastest speed to come, nor of what can be reached.
///
/// @return per unit, not below the smallest usable floor
double default_speed_floor(const scene::Scene& scene, const BelievedPlant& plant,
                           const ControlScales& scales) {
  constexpr double presliding_periods = 3.0;
  const double forgets_m_per_s =
      presliding_m(plant) / (presliding_periods * scales.carrier_period_s);
  const double highest =
      0.5 * std::min(fastest_sliding_m_per_s(scene.sliding), scales.velocity_m_per_s);
  return std::max(control::smallest_speed_floor,
                  std::min(forgets_m_per_s, highest) / scales.velocity_m_per_s);
}

double speed_floor(const scene::Scene& scene, const BelievedPlant& plant,
                   const ControlScales& scales) {
  const std::optional<double>& chosen_m_per_s = scene.controller->speed_floor_m_per_s;
  return chosen_m_per_s
             ? per_unit(
                   *chosen_m_per_s, scales.velocity_m_per_s, control::smallest_speed_floor,
                   "controller.speed_floor_m_per_s",
                   "is {:.3g} of the peak vibration velocity at full drive",
                   fmt::format("{} to below {} m/s",
                               at_least(control::smallest_speed_floor * scales.velocity_m_per_s),
                               at_most(scales.velocity_m_per_s)))
             : default_speed_floor(scene, plant, scales);
}

/// 1/n, below 1: fixed point ends there.
double mean_weight(double samples) {
  constexpr double largest_code = 1.0 - 0x1p-31;
  return std::min(1.0 / samples, largest_code);
}

/// How many carrier periods a sliding in either direction lasts before a time.
struct SlidingSpells {
  std::uint32_t last = 0;      ///< without a break up to that time
  std::uint32_t opposite = 0;  ///< the longest one the other way
};

double sliding_velocity_m_per_s(const std::vector<scene::SpeedPoint>& profile, std::size_t& place,
                                double time_s) {
  while (place + 1 < profile.size() && profile[place + 1].time_s <= time_s) {
    ++place;
  }
  const scene::SpeedPoint& before = profile[place];
  if (place + 1 == profile.size() || time_s <= before.time_s) {
    return before.velocity_m_per_s;
  }
  const scene::SpeedPoint& after = profile[place + 1];
  const double part = (time_s - before.time_s) / (after.time_s - before.time_s);
  return before.velocity_m_per_s + part * (after.velocity_m_per_s - before.velocity_m_per_s);
}

SlidingSpells sliding_spells(const scene::Scene& scene, const ControlDesign& design,
                             std::uint32_t periods) {
  const std::vector<scene::SpeedPoint>& profile = scene.sliding.profile;
  const double floor_m_per_s = design.speed_floor * design.scales.velocity_m_per_s;
  std::array<std::uint32_t, 2> longest{};
  std::uint32_t length = 0;
  bool backwards = false;
  std::size_t place = 0;
  for (std::uint32_t k = 1; k <= periods; ++k) {
    const double velocity_m_per_s =
        sliding_velocity_m_per_s(profile, place, k * design.scales.carrier_period_s);
    const bool turned = (velocity_m_per_s < 0.0) != backwards;
    backwards = velocity_m_per_s < 0.0;
    length = std::abs(velocity_m_per_s) < floor_m_per_s ? 0 : (turned ? 1 : length + 1);
    longest[backwards ? 1 : 0] = std::max(longest[backwards ? 1 : 0], length);
  }
  return {length, longest[backwards ? 0 : 1]};
}

/// Carrier periods in which the contact slides through its presliding travel, so many times, and the
/// sensor settles.
double settling_periods(const scene::Scene& scene, const BelievedPlant& plant,
                        const ControlDesign& design, double presliding_travels) {
  constexpr double filter_settling = 5.0;  // 0.7 % of the force is left
  const ControlScales& scales = design.scales;
  const double speed_m_per_s = std::max(std::abs(scene.sliding.profile.front().velocity_m_per_s),
                                        design.speed_floor * scales.velocity_m_per_s);
  return std::ceil(presliding_travels * presliding_m(plant) /
                       (speed_m_per_s * scales.carrier_period_s) +
                   filter_settling * filter_periods(scene, scales) + scene.sensor.delay_periods);
}

/// Half of the largest difference of readings of a mass at rest. Of many the noise alone, of which
/// nobody may have told, sets some far apart: there nothing is too much.
double half_steady_difference(const scene::Scene& scene, const ControlDesign& design,
                              double readings) {
  constexpr double few = 16.0;
  constexpr double part = 0.4;  // of the friction
  constexpr double noise_deviations = 10.0;
  constexpr double anything = 1.0;
  const double told = part * design.friction_force +
                      noise_deviations * scene.sensor.force_noise_N / design.scales.force_N;
  return readings > few ? anything : std::min(0.5 * told, anything);
}

constexpr double least_presliding_travels = 7.0;  // 0.1 % of the force is left
constexpr double usual_presliding_travels = 2.0 * least_presliding_travels;

/// The contact must slide through its presliding travel, and the sensor settle, before the friction
/// force can be learnt; in both directions where the sliding turns meanwhile.
void design_calibration(const scene::Scene& scene, const BelievedPlant& plant,
                        ControlDesign& design) {
  if (scene.controller->calibration_s <= 0.0) {
    return;
  }
  const ControlScales& scales = design.scales;
  const double settling = settling_periods(scene, plant, design, least_presliding_travels);
  const double total = std::round(scene.controller->calibration_s / scales.carrier_period_s) - 1.0;
  if (total < settling + 1.0) {
    throw ConfigurationError(
        "controller.calibration_s",
        fmt::format(
            "is too short for contact and sensor to settle; allowed: 0 (no calibration), or "
            "at least {} s",
            at_least((settling + 2.0) * scales.carrier_period_s, 3)));
  }
  design.calibrated = true;
  design.calibration_total_periods = static_cast<std::uint32_t>(total);
  const SlidingSpells spells = sliding_spells(scene, design, design.calibration_total_periods);
  // A sliding that begins too late for it makes the calibration longer.
  const double last = spells.last > settling ? spells.last : total;
  const double available =
      spells.opposite > settling ? std::min<double>(last, spells.opposite) : last;
  constexpr double most_averaged = 65536.0;  // more would only add up roundings in float32
  const double averaged =
      std::min({available - settling, std::ceil(0.5 * available), most_averaged});
  design.calibration_average_periods = static_cast<std::uint32_t>(averaged);
  design.calibration_settle_periods = static_cast<std::uint32_t>(available - averaged);
  design.calibration_weight = mean_weight(averaged);
  design.calibration_half_steady = half_steady_difference(scene, design, averaged);
}

/// Of the undriven force, whose mean their noise moves by no more than 0.25 % rms; at most 16.
double readings_for_mean(const scene::Scene& scene, const BelievedPlant& plant) {
  constexpr double error = 0.0025;
  constexpr double most = 16.0;
  const double noise = scene.sensor.force_noise_N / (error * plant.friction_N);
  return std::clamp(std::ceil(noise * noise), 1.0, most);
}

/// Of a calibration that the contact slides through so many of its presliding travels.
double calibration_periods(const scene::Scene& scene, const BelievedPlant& plant,
                           const ControlDesign& design, double travels) {
  return settling_periods(scene, plant, design, travels) + readings_for_mean(scene, plant) + 2.0;
}

/// A pause long enough for the presliding travel, and for as many readings as their noise asks for.
void design_relearning(const scene::Scene& scene, const BelievedPlant& plant,
                       ControlDesign& design) {
  if (!scene.controller->relearn_every_s) {
    return;
  }
  constexpr double presliding_travels = 6.0;  // 0.15 % of the force is left
  constexpr double filter_settling = 5.0;     // 0.7 % of it
  constexpr double contact_settling = 2.0;    // carrier periods until the contact has forgotten
  const ControlScales& scales = design.scales;
  const double shaping = changing_periods(design);
  const double slewing = design.slew_limited ? 1.0 / design.slew_per_period : 0.0;
  design.relearn_quiet_periods =
      whole_periods(shaping + slewing + filter_settling * filter_periods(scene, scales));
  design.relearn_reading_periods = whole_periods(latency_periods(scene));
  design.relearn_return_periods = whole_periods(shaping + slewing + contact_settling);
  design.relearn_average_periods = static_cast<std::uint8_t>(readings_for_mean(scene, plant));
  design.relearn_weight = mean_weight(design.relearn_average_periods);
  design.relearn_travel = presliding_travels * presliding_m(plant) /
                          (64.0 * scales.velocity_m_per_s * scales.carrier_period_s);
  const double every = std::round(*scene.controller->relearn_every_s / scales.carrier_period_s);
  const double shortest = 10.0 * (design.relearn_quiet_periods + design.relearn_reading_periods +
                                  design.relearn_return_periods + design.relearn_average_periods);
  if (!(every >= shortest && design.relearn_travel < 1.0)) {
    throw ConfigurationError(
        "controller.relearn_every_s",
        design.relearn_travel < 1.0
            ? fmt::format("leaves no time between two pauses of the drive; allowed: at least {} s",
                          at_least(shortest * scales.carrier_period_s, 3))
            : "cannot be kept: the presliding travel takes more than 64 carrier periods at the "
              "peak "
              "vibration velocity of full drive; remove it");
  }
  design.relearn_every_periods = static_cast<std::uint32_t>(std::min(every, 4e9));
}

/// The undriven friction must be some codes, or a healthy sensor would pass for a stuck one.
constexpr double fewest_codes = 8.0;

void check_converter(const scene::Scene& scene, const BelievedPlant& plant) {
  const auto too_coarse = [&](int bits) {
    scene::Sensor sensor = scene.sensor;
    sensor.adc_bits = bits;
    return fewest_codes * code_N(sensor) > plant.friction_N;
  };
  if (scene.sensor.adc_bits && too_coarse(*scene.sensor.adc_bits)) {
    int bits = *scene.sensor.adc_bits;
    while (too_coarse(bits)) {
      ++bits;
    }
    throw ConfigurationError(
        "sensor.adc_bits",
        fmt::format(
            "one code is {:.3g} of the believed friction force; allowed: at least {} bits, or a "
            "smaller sensor.force_full_scale_N",
            code_N(scene.sensor) / plant.friction_N, bits));
  }
}

/// At a fixed frequency.
void require_settling(const BelievedPlant& plant, double omega_rad_per_s) {
  // At resonance the vibration takes about as many radians to build up as it is amplified.
  constexpr double largest_amplification = 1000.0;
  const double inertia_N_per_m = plant.mass_kg * omega_rad_per_s * omega_rad_per_s;
  if (!(inertia_N_per_m <=
        largest_amplification * dynamic_stiffness_N_per_m(plant, omega_rad_per_s))) {
    throw ConfigurationError(
        "drive.frequency_Hz",
        "is the plant's natural frequency, and with so little damping the vibration never settles; "
        "allowed: another frequency, more plant.damping_N_s_per_m, or with a [transducer] "
        "controller.vibration = \"resonant\"");
  }
}

void require_wide_range(double full_scale_m_per_s, double fastest_m_per_s) {
  if (2.0 * control::smallest_speed_floor * full_scale_m_per_s > fastest_m_per_s) {
    throw ConfigurationError(
        "sensor.vibration_full_scale_m_per_s",
        fmt::format("{:g} m/s is too much beside the fastest sliding, which has the same range; "
                    "allowed: at most {} m/s",
                    full_scale_m_per_s,
                    at_most(0.5 * fastest_m_per_s / control::smallest_speed_floor)));
  }
  if (!(fastest_m_per_s < full_scale_m_per_s)) {
    throw ConfigurationError(
        "sensor.vibration_full_scale_m_per_s",
        fmt::format("{:g} m/s is below the fastest sliding, which the vibration has to exceed; "
                    "allowed: above {} m/s",
                    full_scale_m_per_s, at_least(fastest_m_per_s)));
  }
}

/// The range of the vibration sensor.
double full_scale_m_per_s(const scene::Scene& scene, const BelievedPlant& plant) {
  if (scene.resonant()) {
    return resonant_full_scale_m_per_s(scene, plant);
  }
  require_settling(plant, numeric::two_pi * scene.drive->frequency_Hz);
  return damped_full_scale_m_per_s(scene, plant);
}

void require_sliding(const scene::Scene& scene, double fastest_m_per_s) {
  if (fastest_m_per_s == 0.0) {
    throw ConfigurationError(
        "sliding.velocity_m_per_s",
        fmt::format("is 0 all the time, where no vibration changes the friction; allowed: another "
                    "velocity with controller.vibration = \"{}\"",
                    scene::name_of(scene::vibration_controls, *scene.controller->vibration)));
  }
}

/// @return displacement amplitude at the velocity that is the base of all
double set_observed_scales(const scene::Scene& scene, const BelievedPlant& plant,
                           ControlDesign& design) {
  const double fastest_m_per_s = fastest_sliding_m_per_s(scene.sliding);
  require_sliding(scene, fastest_m_per_s);
  const double velocity_m_per_s = full_scale_m_per_s(scene, plant);
  const double force_N =
      scene.sensor.force
          ? scene.sensor.force_full_scale_N
          : 2.0 * std::max(plant.friction_N, largest_friction_limit_N(scene.friction));
  design.scales = {1.0 / scene.drive->frequency_Hz, force_N, velocity_m_per_s,
                   scene.drive->max_force_amplitude_N};
  if (scene.resonant()) {
    require_needed_range(scene, plant, velocity_m_per_s);
  }
  require_wide_range(velocity_m_per_s, fastest_m_per_s);
  return velocity_m_per_s / (numeric::two_pi * scene.drive->frequency_Hz);
}

/// @return displacement amplitude at the velocity that is the base of all
double set_scales(const scene::Scene& scene, const BelievedPlant& plant, ControlDesign& design) {
  if (scene.observes_vibration()) {
    return set_observed_scales(scene, plant, design);
  }
  const double omega = numeric::two_pi * scene.drive->frequency_Hz;
  require_settling(plant, omega);
  double room = 1.0;
  if (scene.feels_vibration()) {
    require_sliding(scene, fastest_sliding_m_per_s(scene.sliding));
    room = felt_room;
  }
  const double displacement_m =
      room * scene.drive->max_force_amplitude_N / dynamic_stiffness_N_per_m(plant, omega);
  design.scales = {1.0 / scene.drive->frequency_Hz, scene.sensor.force_full_scale_N,
                   displacement_m * omega, scene.drive->max_force_amplitude_N};
  return displacement_m;
}

/// The slew limit holds behind the shaper, whose taps may add up.
void design_slew(const scene::Drive& drive, ControlDesign& design) {
  if (!drive.max_force_slew_N_per_s) {
    return;
  }
  double gain = design.notch ? 0.0 : 1.0;
  if (design.notch) {
    for (const double tap : design.notch->taps) {
      gain += std::abs(tap);
    }
  }
  const double per_period = *drive.max_force_slew_N_per_s * design.scales.carrier_period_s /
                            design.scales.drive_amplitude_N;
  design.slew_limited = per_period < gain;
  design.slew_per_period = per_period / gain;
}

void add_notch_notes(const NotchDesign& notch, std::vector<std::string>& notes) {
  constexpr int longest_span = 16;  // carrier periods, in which a step is over at Table 1
  if (notch.ripple > robust_ripple) {
    notes.push_back(fmt::format(
        "The robust notch leaves up to {:.2g} % of the ringing of each step where the natural "
        "frequency is off by up to {:.3g} %. A smaller controller.shaping_range leaves less.",
        100.0 * notch.ripple, 100.0 * notch.range));
  }
  if (notch.span() <= longest_span) {
    return;
  }
  if (notch.range > 0.0) {
    notes.push_back(
        fmt::format("The robust notch spans {} carrier periods. Targets, speeds and sensors that "
                    "change faster are not followed.",
                    notch.span()));
    return;
  }
  notes.push_back(fmt::format(
      "The natural mode is so near a multiple of the carrier frequency that its notch spans {} "
      "carrier periods: {} of them after each change the drive stands at {:.0f} % of it, then {} "
      "at {:.0f} %. Targets, speeds and sensors that change faster are not followed.",
      notch.span(), notch.spacing, 100.0 * notch.taps[0], notch.spacing,
      100.0 * (notch.taps[0] + notch.taps[1])));
}

}  // namespace

ControlDesign design_control(const scene::Scene& any_scene) {
  const scene::Scene& scene = any_scene.believed();
  const BelievedPlant plant = believed_plant(scene);
  ControlDesign design;
  design.map = scene::friction_map(scene.friction.law);
  design.senses_force = scene.sensor.force;
  design.relearns = scene.controller->relearn_every_s.has_value();
  const double displacement_m = set_scales(scene, plant, design);
  design.friction_force = per_unit(plant.friction_N, design.scales.force_N, smallest_friction,
                                   "sensor.force_full_scale_N",
                                   fmt::format("is {:.4g} N, of which the believed friction force "
                                               "of {:.4g} N makes {{:.3g}}",
                                               design.scales.force_N, plant.friction_N),
                                   fmt::format("above {}, at most {} N", at_least(plant.friction_N),
                                               at_most(plant.friction_N / smallest_friction)));
  design.contact_force = plant.contact_stiffness_N_per_m * displacement_m / design.scales.force_N;
  design.speed_floor = speed_floor(scene, plant, design.scales);
  check_converter(scene, plant);
  design.smallest_friction =
      std::max(smallest_friction, fewest_codes * code_N(scene.sensor) / design.scales.force_N);
  if (scene.resonant()) {
    design.resonance = design_resonance(scene, plant, design.scales.velocity_m_per_s);
    design_outer_regulator(scene, design);
  } else if (scene.observes_vibration()) {
    design.damping = design_damping(scene, plant, design.scales.velocity_m_per_s);
    design_outer_regulator(scene, design);
  } else if (scene.feels_vibration()) {
    design.feeling = design_felt(scene, plant, design.scales.velocity_m_per_s);
    design_outer_regulator(scene, design);
    design.integral_gain = 0.0;  // the observer's constant is the integral
  } else {
    const NaturalMode mode = natural_mode(plant, design.scales.carrier_period_s);
    design_shaper(scene, mode, design);
    design_regulator(scene, mode, plant.mass_kg, design);
  }
  design_supervision(scene, plant, design);
  design_calibration(scene, plant, design);
  design.usual_calibration_s = calibration_periods(scene, plant, design, usual_presliding_travels) *
                               design.scales.carrier_period_s;
  design_slew(*scene.drive, design);
  design_relearning(scene, plant, design);
  return design;
}

std::optional<ControlDesign> design_if_closed(const scene::Scene& scene) {
  return scene.controller ? std::optional<ControlDesign>(design_control(scene)) : std::nullopt;
}

double shortest_calibration_s(const scene::Scene& scene, const ControlDesign& design) {
  constexpr double largest_part = 0.5;  // of the time of the first target
  const BelievedPlant plant = believed_plant(scene);
  const auto& targets = scene.controller->target_friction_ratio;
  const double first_s =
      targets.size() > 1 ? std::min(targets[1].time_s, scene.run.duration_s) : scene.run.duration_s;
  const double period_s = design.scales.carrier_period_s;
  const double most = std::floor(largest_part * first_s / period_s);
  const double chosen =
      std::min(calibration_periods(scene, plant, design, usual_presliding_travels), most);
  const double least = calibration_periods(scene, plant, design, least_presliding_travels);
  const auto begun = static_cast<std::uint32_t>(std::max(0.0, chosen));
  return chosen < least || sliding_spells(scene, design, begun).last < least ? 0.0
                                                                             : chosen * period_s;
}

bool tells_mismatch(const scene::Scene& scene) {
  constexpr double light_friction = 0.02;  // of the drive
  return scene::has_own_map(scene.friction.law) &&
         scene.drive->waveform == scene::Waveform::cosine &&
         believed_plant(scene).friction_N <
             light_friction * scene.believed().drive->max_force_amplitude_N;
}

namespace {

/// How far the stiffness may be off, where that is less than usual and not told by another note.
void add_stiffness_note(const FeltDesign& design, std::vector<std::string>& notes) {
  constexpr double usual_range = 0.05;
  const double least = std::min({design.stiffness_range, design.turn_range, design.multiple_range});
  if (least >= usual_range || design.multiple_range <= 0.0) {
    return;
  }
  if (least == design.stiffness_range) {
    notes.push_back(
        fmt::format("The natural mode is looked for only where the stiffness is within {:.2g} % of "
                    "the believed one: it is close to the carrier frequency.",
                    100.0 * least));
    return;
  }
  notes.push_back(fmt::format(
      "A stiffness that is off by more than {:.2g} % may keep the friction ratio from settling: "
      "the natural mode {}.",
      100.0 * least,
      least == design.turn_range
          ? "then turns by more than 0.3 rad otherwise than believed in a carrier period"
          : "may then be within 0.06 carrier frequencies of zero or of a multiple of the carrier"));
}

void add_feeling_notes(const FeltDesign& design, std::vector<std::string>& notes) {
  if (!design.apart) {
    notes.push_back(
        "The natural mode is beside zero or a multiple of the carrier frequency, within 0.5 % of "
        "that frequency: it cannot be told from the vibration and rings with it. The friction "
        "ratio is fed back alone, and stays off its target where the stiffness is not the believed "
        "one or what rings from the last target is too loud.");
  } else {
    if (!design.quick) {
      notes.push_back(
          "The natural mode is so near 0 or a multiple of the carrier frequency that no change of "
          "the amplitude quiets it quickly: the friction ratio may swing about its target or stay "
          "off it, most of all where the stiffness is not the believed one. Another carrier "
          "frequency is surer.");
    }
    add_stiffness_note(design, notes);
  }
  constexpr double usual_blur = 0.02;
  if (design.blur > usual_blur) {
    notes.push_back(fmt::format(
        "The force sensor shows little of the natural mode: a reading whose lag is taken out is "
        "uncertain by {:.3g} % of the vibration velocity. A quicker one, or one with "
        "less noise, shows more; so does a sensor.vibration.",
        100.0 * design.blur));
  }
}

}  // namespace

std::vector<std::string> design_notes(const ControlDesign& design) {
  std::vector<std::string> notes;
  if (design.free_mode) {
    notes.push_back(
        fmt::format("No notch is on the natural mode: each change of the drive makes it ring. The "
                    "feedback gain is {:.3g} per carrier period.",
                    design.integral_gain));
  }
  if (design.free_mode && design.shaping_range > 0.0) {
    notes.push_back(
        fmt::format("No robust notch quiets a natural mode that may be off by {:.3g} % in "
                    "frequency. A smaller controller.shaping_range, or another carrier frequency, "
                    "may leave room for one.",
                    100.0 * design.shaping_range));
  }
  if (design.damping && !design.damping->quick) {
    notes.push_back(
        "The natural mode is so near 0 or a multiple of the carrier frequency that no change of "
        "the amplitude quiets it quickly: the vibration velocity is held, and the friction ratio "
        "may swing about its target.");
  }
  if (design.feeling && !design.calibrated) {
    notes.push_back(fmt::format(
        "The friction force of the scene is believed: where it is another, the friction ratio is "
        "off by as much. A controller.calibration_s of {:.3g} s learns it with the drive off; the "
        "first target has to hold for twice as long. Without that key it is learnt where the first "
        "target does.",
        design.usual_calibration_s));
  }
  if (design.feeling) {
    add_feeling_notes(*design.feeling, notes);
  }
  if (design.resonance && design.resonance->natural != design.resonance->believed_natural) {
    const ResonantDesign& resonance = *design.resonance;
    const auto frequency_Hz = [&](double deviation) {
      return (1.0 + deviation) / design.scales.carrier_period_s;
    };
    notes.push_back(fmt::format(
        "The believed natural frequency of {:.6g} Hz is outside the frequency range of {:.6g} to "
        "{:.6g} Hz: the controller begins at the nearest end.",
        frequency_Hz(resonance.believed_natural), frequency_Hz(resonance.lowest),
        frequency_Hz(resonance.highest)));
  }
  if (design.notch) {
    add_notch_notes(*design.notch, notes);
  }
  if (design.missing_damping_N_s_per_m > 0.0) {
    constexpr double never_rounded_down = 1.005;  // to three digits
    notes.push_back(fmt::format(
        "The natural mode hardly decays. Feedback may make what the robust notch leaves of its "
        "ringing grow over thousands of carrier periods, also where the stiffness is known "
        "exactly. A plant.damping_N_s_per_m of {:.3g} or more prevents it.",
        never_rounded_down * design.missing_damping_N_s_per_m));
  }
  return notes;
}

}  // namespace sonoglide::configure
