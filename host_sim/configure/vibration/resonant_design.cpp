#include "host_sim/configure/vibration/resonant_design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/friction/inverse_design.hpp"
#include "host_sim/configure/friction/vibration_map.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/configure/sensor_noise.hpp"
#include "host_sim/scene/bound.hpp"

namespace sonoglide::configure {
namespace {

double full_force_N(const scene::Scene& scene, const NominalPlant& plant) {
  return scene.max_drive_force_N() * plant.force_factor;
}

/// In the steady state at resonance, friction left out.
double full_drive_m_per_s(const scene::Scene& scene, const NominalPlant& plant) {
  if (!(plant.stiffness_N_per_m > 0.0)) {
    throw ConfigurationError("plant.stiffness_N_per_m",
                             "is 0, and a mass without a spring has no resonance; allowed: above 0 "
                             "with controller.vibration = \"resonant\"");
  }
  if (!(plant.damping_N_s_per_m > 0.0)) {
    throw ConfigurationError("plant.damping_N_s_per_m",
                             "is 0, and a resonance without losses has no steady vibration; "
                             "allowed: above 0 with controller.vibration = \"resonant\"");
  }
  return full_force_N(scene, plant) / plant.damping_N_s_per_m;
}

/// Of the targets that are driven for, at the fastest sliding.
struct TargetVelocities {
  double lowest_m_per_s = std::numeric_limits<double>::infinity();
  double lowest_driven_m_per_s = std::numeric_limits<double>::infinity();  ///< above 0
  double highest_m_per_s = 0.0;
};

TargetVelocities target_velocities(const scene::Scene& scene, const NominalPlant& plant,
                                   double most_m_per_s) {
  const double fastest_m_per_s = scene.sliding.fastest_m_per_s();
  const VibrationMap map{scene::friction_map(scene.friction.law), most_m_per_s,
                         plant.contact_stiffness_N_per_m * most_m_per_s /
                             (scene.drive->rate_rad_per_s() * plant.friction_N)};
  const bool tabulated = is_tabulated(scene);
  TargetVelocities velocities;
  for (const double target : plant.target_ratios(*scene.controller)) {
    const double velocity_m_per_s =
        tabulated && target < 1.0
            ? std::min(required_vibration_m_per_s(scene, plant, target), most_m_per_s)
            : map.velocity_m_per_s(target, fastest_m_per_s);
    velocities.lowest_m_per_s = std::min(velocities.lowest_m_per_s, velocity_m_per_s);
    if (velocity_m_per_s > 0.0) {
      velocities.lowest_driven_m_per_s =
          std::min(velocities.lowest_driven_m_per_s, velocity_m_per_s);
    }
    velocities.highest_m_per_s = std::max(velocities.highest_m_per_s, velocity_m_per_s);
  }
  return velocities;
}

/// The direction of a vibration is then known to 1/16 radian, rms.
constexpr double noises_of_audible = 16.0;

/// Of what a period at full drive adds: friction that sets in moves the mass as well, by less.
constexpr double least_audible = 0.25;

/// The noisier a period's growth against what full drive adds, the less of it is believed.
void design_estimate(ResonantDesign& design) {
  constexpr double at_once = 0.5;
  constexpr double nominal_rate_error = 0.2;             // relative; of a force factor, of a mass
  constexpr double nominal_losses_error = 0.07;          // relative, of a period to the next
  const double blur = 2.0 * design.noise / design.rate;  // of a growth, as a drive
  const auto gain = [&](double error) { return at_once / (1.0 + blur * blur / (error * error)); };
  design.rate_gain = gain(nominal_rate_error);
  design.losses_gain = gain(nominal_losses_error);
  constexpr double of_noise = 0.04;
  design.quiet_losses = std::min(1.0, of_noise / design.losses_gain);
  design.natural_gain = 0.05;
  design.audible = std::max(least_audible * design.rate, noises_of_audible * design.noise);
  design.surprise = 1.0 + 4.0 * blur;
  design.unrest = 2.0 * blur;
  design.missing = 0.25 * design.rate;
}

void design_hold(ResonantDesign& design) {
  constexpr double nearly_at_once = 0.8;
  constexpr double phase = 1.0 / 16.0;
  constexpr double coarse = 0.25;
  constexpr double deviations = 4.0;
  constexpr double of_noise = 0.15;
  constexpr double deviations_of_noise = 3.0;
  design.velocity_gain = nearly_at_once / (1.0 + 2.0 * design.noise / design.rate);
  design.calm = std::max(0.0, 1.0 - of_noise / design.velocity_gain);
  design.quiet = deviations_of_noise * design.noise;
  // The phase that a word's own rounding leaves must not move it, but by next to nothing.
  const double step = 1.0 / design.start_word;
  const double width = 1.0 / (design.quality_factor * design.quality_factor);
  design.phase_gain = step > coarse * width ? 0.0 : phase;
  design.settled = deviations * design.noise;
}

void design_word(const scene::Scene& scene, const NominalPlant& plant, ResonantDesign& design) {
  const scene::Drive& drive = *scene.drive;
  constexpr double finest = 0x1p-28;  // of the start
  constexpr double default_range = 0.05;
  design.step_Hz = drive.frequency_resolution_Hz > 0.0 ? drive.frequency_resolution_Hz
                                                       : finest * drive.frequency_Hz;
  design.start_word = static_cast<std::uint32_t>(std::round(drive.frequency_Hz / design.step_Hz));
  const auto& range = scene.controller->frequency_range_Hz;
  const auto deviation = [&](double frequency_Hz) {
    return frequency_Hz / drive.frequency_Hz - 1.0;
  };
  // A step of the word is in force until the wanted frequency is 3/4 of a step away.
  const double inside = 0.75 / design.start_word;
  design.lowest = range ? std::min(0.0, deviation(range->lowest_Hz) + inside) : -default_range;
  design.highest = range ? std::max(0.0, deviation(range->highest_Hz) - inside) : default_range;
  const double natural_Hz =
      numeric::sqrt(plant.stiffness_N_per_m / plant.mass_kg) / numeric::two_pi;
  design.nominal_natural = deviation(natural_Hz);
  design.natural = std::clamp(design.nominal_natural, design.lowest, design.highest);
}

/// @param least_m_per_s  of the targets
void design_current(const scene::Scene& scene, const NominalPlant& plant, double full_scale_m_per_s,
                    double least_m_per_s, ResonantDesign& design) {
  const scene::Drive& drive = *scene.drive;
  if (!drive.max_current_amplitude_A) {
    return;
  }
  const scene::Transducer& transducer = *scene.transducer;
  const double limit_A = *drive.max_current_amplitude_A;
  if (transducer.loss_tangent > 1.0) {
    throw ConfigurationError("transducer.loss_tangent",
                             fmt::format("{:g} is no capacitance's; allowed: at most 1 with a "
                                         "drive.max_current_amplitude_A",
                                         transducer.loss_tangent));
  }
  design.current_limited = true;
  design.loss_tangent = transducer.loss_tangent;
  design.motional =
      plant.force_factor * transducer.force_factor_N_per_V * full_scale_m_per_s / limit_A;
  const double clamped_S = scene.drive->rate_rad_per_s() * transducer.clamped_capacitance_F;
  constexpr double smallest = 1e-9;
  design.capacitive = std::max(smallest, clamped_S * drive.max_voltage_amplitude_V / limit_A);
  const double held_by_V = least_m_per_s * plant.damping_N_s_per_m /
                           (plant.force_factor * transducer.force_factor_N_per_V);
  const double least_A = clamped_S * held_by_V;
  if (!(least_A < limit_A)) {
    throw ConfigurationError(
        "drive.max_current_amplitude_A",
        fmt::format("{:g} A is less than what the clamped capacitance alone takes at the {:.4g} V "
                    "that the easiest target needs; allowed: above {} A",
                    limit_A, held_by_V, scene::at_least(least_A, 4)));
  }
}

/// What one of two independent errors may be for both to be this rms; half of it where the other is
/// too large by itself.
double room_beside(double other, double both) {
  return other < both ? std::sqrt(both * both - other * other) : std::sqrt(0.5) * both;
}

/// A target whose vibration has no direction would never be driven.
/// @param full_m_per_s  at full drive
void require_audible_targets(const scene::Scene& scene, double lowest_m_per_s, double full_m_per_s,
                             double full_scale_m_per_s, const ResonantDesign& design) {
  const double audible_m_per_s = design.audible * full_scale_m_per_s;
  if (audible_m_per_s < lowest_m_per_s) {
    return;
  }
  const double allowed = lowest_m_per_s / audible_m_per_s;
  if (design.audible > least_audible * design.rate) {
    constexpr double rounding = 1e-9;
    const bool wants_all = lowest_m_per_s >= (1.0 - rounding) * full_m_per_s;
    if (wants_all) {
      const double most_V = scene.drive->max_voltage_amplitude_V;
      throw ConfigurationError(
          "drive.max_voltage_amplitude_V",
          fmt::format(
              "{:g} V give a vibration of {:.3g} m/s at most, and the noise and the converter of "
              "the vibration sensor hide one below {:.3g} m/s; allowed: above {} V",
              most_V, full_m_per_s, audible_m_per_s,
              scene::at_least(most_V * audible_m_per_s / full_m_per_s, 4)));
    }
    const double noise_m_per_s = scene.sensor.vibration_noise_m_per_s;
    const double rounding_m_per_s = vibration_rounding_m_per_s(scene.sensor, full_scale_m_per_s);
    const double most_m_per_s = lowest_m_per_s / noises_of_audible;
    const bool coarse = noise_m_per_s < rounding_m_per_s;
    const double room_m_per_s =
        room_beside(coarse ? noise_m_per_s : rounding_m_per_s, most_m_per_s);
    throw ConfigurationError(
        coarse ? "sensor.vibration_bits" : "sensor.vibration_noise_m_per_s",
        fmt::format("noise and converter hide a vibration below {:.3g} m/s, and a target needs "
                    "{:.3g} m/s; allowed: {}, or a lower target",
                    audible_m_per_s, lowest_m_per_s,
                    coarse ? fmt::format("at least {:.0f} bits",
                                         *scene.sensor.vibration_bits +
                                             std::ceil(std::log2(rounding_m_per_s / room_m_per_s)))
                           : fmt::format("at most {} m/s", scene::at_most(room_m_per_s, 3))));
  }
  throw ConfigurationError(
      "drive.max_voltage_amplitude_V",
      fmt::format("is too strong for a vibration below {:.3g} m/s, and a target needs {:.3g} m/s; "
                  "allowed: at most {} V, or a lower target",
                  audible_m_per_s, lowest_m_per_s,
                  scene::at_most(allowed * scene.drive->max_voltage_amplitude_V, 4)));
}

/// Largest vibration velocity of a target that full drive reaches.
double needed_vibration_m_per_s(const scene::Scene& scene, const NominalPlant& plant) {
  return target_velocities(scene, plant, full_drive_m_per_s(scene, plant)).highest_m_per_s;
}

}  // namespace

double ResonantDesign::changing_periods() const {
  constexpr double latency = 8.0;
  const double room = std::max(1.01, head_room);
  const double constants = -numeric::log2(1.0 - 1.0 / room) * 0.69314718055994531;
  return latency + constants * 2.0 * quality_factor / numeric::two_pi;
}

double resonant_full_scale_m_per_s(const scene::Scene& scene, const NominalPlant& plant) {
  if (scene.sensor.vibration_full_scale_m_per_s) {
    return *scene.sensor.vibration_full_scale_m_per_s;
  }
  constexpr double room = 4.0;  // for what feedback may ask for, and for what a knock adds
  return room * std::max(needed_vibration_m_per_s(scene, plant), scene.sliding.fastest_m_per_s());
}

void require_needed_range(const scene::Scene& scene, const NominalPlant& plant,
                          double full_scale_m_per_s) {
  const double needed_m_per_s = needed_vibration_m_per_s(scene, plant);
  if (!(needed_m_per_s < full_scale_m_per_s)) {
    throw ConfigurationError(
        "sensor.vibration_full_scale_m_per_s",
        fmt::format("{:g} m/s is below what a target needs; allowed: above {} m/s",
                    full_scale_m_per_s, scene::at_least(needed_m_per_s, 4)));
  }
}

ResonantDesign design_resonance(const scene::Scene& scene, const NominalPlant& plant,
                                double full_scale_m_per_s) {
  const double full_m_per_s = full_drive_m_per_s(scene, plant);
  const double natural_rad_per_s = numeric::sqrt(plant.stiffness_N_per_m / plant.mass_kg);
  const TargetVelocities targets = target_velocities(scene, plant, full_m_per_s);
  ResonantDesign design;
  design.rate = full_force_N(scene, plant) /
                (2.0 * plant.mass_kg * scene.drive->frequency_Hz * full_scale_m_per_s);
  constexpr double largest_rate = 0.5;
  if (design.rate > largest_rate) {
    throw ConfigurationError(
        "drive.max_voltage_amplitude_V",
        fmt::format(
            "adds {:.3g} times the vibration sensor's range of {:.4g} m/s in a carrier "
            "period; allowed: at most {} V, or a larger "
            "sensor.vibration_full_scale_m_per_s",
            design.rate, full_scale_m_per_s,
            scene::at_most(scene.drive->max_voltage_amplitude_V * largest_rate / design.rate, 4)));
  }
  design.losses = full_scale_m_per_s / full_m_per_s;
  design.quality_factor = plant.mass_kg * natural_rad_per_s / plant.damping_N_s_per_m;
  design.head_room = full_m_per_s / targets.highest_m_per_s;
  design.noise = vibration_noise_m_per_s(scene.sensor, full_scale_m_per_s) / full_scale_m_per_s;
  design.delay_periods = static_cast<std::uint8_t>(scene.drive->delay_periods);
  design.scales = scene.sensor.vibration == scene::VibrationSensor::motional_current;
  design_word(scene, plant, design);
  design_estimate(design);
  require_audible_targets(scene, targets.lowest_driven_m_per_s, full_m_per_s, full_scale_m_per_s,
                          design);
  design_hold(design);
  design_current(scene, plant, full_scale_m_per_s, targets.lowest_m_per_s, design);
  return design;
}

}  // namespace sonoglide::configure
