#include "host_sim/configure/design_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "firmware/control/controller.hpp"
#include "firmware/control/friction/friction_level.hpp"
#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/scene/bound.hpp"
#include "host_sim/scene/names.hpp"

namespace sonoglide::configure {

double code_N(const scene::Sensor& sensor) {
  return sensor.adc_bits ? 2.0 * sensor.force_full_scale_N * std::exp2(-*sensor.adc_bits) : 0.0;
}

double presliding_m(const NominalPlant& plant) {
  return plant.contact_stiffness_N_per_m > 0.0 ? plant.friction_N / plant.contact_stiffness_N_per_m
                                               : 0.0;
}

double resolution(scene::Arithmetic arithmetic) {
  return arithmetic == scene::Arithmetic::q15   ? 0x1p-15
         : arithmetic == scene::Arithmetic::q31 ? 0x1p-31
                                                : 0.0;
}

namespace {

/// The controller's resolution ends here, per unit.
constexpr double smallest_friction = control::FrictionLevel<double>::smallest();

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

/// Slowest sliding at which the friction ratio is taken as defined by its steady map: the contact's
/// presliding travel takes at most three carrier periods, so that it forgets faster than a speed is
/// likely to change. Never more than half of the fastest speed to come, nor of what can be reached.
///
/// @return per unit, not below the smallest usable floor
double default_speed_floor(const scene::Scene& scene, const NominalPlant& plant,
                           const ControlScales& scales) {
  constexpr double presliding_periods = 3.0;
  const double forgets_m_per_s =
      presliding_m(plant) / (presliding_periods * scales.carrier_period_s);
  const double highest = 0.5 * std::min(scene.sliding.fastest_m_per_s(), scales.velocity_m_per_s);
  return std::max(control::smallest_speed_floor,
                  std::min(forgets_m_per_s, highest) / scales.velocity_m_per_s);
}

double speed_floor(const scene::Scene& scene, const NominalPlant& plant,
                   const ControlScales& scales) {
  const std::optional<double>& chosen_m_per_s = scene.controller->speed_floor_m_per_s;
  return chosen_m_per_s ? per_unit(*chosen_m_per_s, scales.velocity_m_per_s,
                                   control::smallest_speed_floor, "controller.speed_floor_m_per_s",
                                   "is {:.3g} of the peak vibration velocity at full drive",
                                   fmt::format("{} to below {} m/s",
                                               scene::at_least(control::smallest_speed_floor *
                                                               scales.velocity_m_per_s),
                                               scene::at_most(scales.velocity_m_per_s)))
                        : default_speed_floor(scene, plant, scales);
}

/// The undriven friction must be some codes, or a healthy sensor would pass for a stuck one.
constexpr double fewest_codes = 8.0;

void check_converter(const scene::Scene& scene, const NominalPlant& plant) {
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
            "one code is {:.3g} of the nominal friction force; allowed: at least {} bits, or a "
            "smaller sensor.force_full_scale_N",
            code_N(scene.sensor) / plant.friction_N, bits));
  }
}

/// At a fixed frequency.
void require_settling(const NominalPlant& plant, double omega_rad_per_s) {
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
                    scene::at_most(0.5 * fastest_m_per_s / control::smallest_speed_floor)));
  }
  if (!(fastest_m_per_s < full_scale_m_per_s)) {
    throw ConfigurationError(
        "sensor.vibration_full_scale_m_per_s",
        fmt::format("{:g} m/s is below the fastest sliding, which the vibration has to exceed; "
                    "allowed: above {} m/s",
                    full_scale_m_per_s, scene::at_least(fastest_m_per_s)));
  }
}

void require_sliding(const scene::Scene& scene, double fastest_m_per_s) {
  if (fastest_m_per_s == 0.0) {
    throw ConfigurationError(
        scene.load ? "load.initial_velocity_m_per_s" : "sliding.velocity_m_per_s",
        fmt::format("is 0 all the time, where no vibration changes the friction; allowed: another "
                    "velocity with controller.vibration = \"{}\"",
                    scene::name_of(scene::vibration_controls, *scene.controller->vibration)));
  }
}

double damped_range_m_per_s(const scene::Scene& scene, const NominalPlant& plant) {
  require_settling(plant, scene.drive->rate_rad_per_s());
  return damped_full_scale_m_per_s(scene, plant);
}

double resonant_range_m_per_s(const scene::Scene& scene, const NominalPlant& plant) {
  const double full_scale_m_per_s = resonant_full_scale_m_per_s(scene, plant);
  require_needed_range(scene, plant, full_scale_m_per_s);
  return full_scale_m_per_s;
}

/// @param range_m_per_s  of the vibration sensor
/// @return displacement amplitude at the velocity that is the base of all
template <class Range>
double set_observed_scales(const scene::Scene& scene, const NominalPlant& plant,
                           const Range& range_m_per_s, ControlDesign& design) {
  const double fastest_m_per_s = scene.sliding.fastest_m_per_s();
  require_sliding(scene, fastest_m_per_s);
  const double velocity_m_per_s = range_m_per_s(scene, plant);
  const double force_N = scene.sensor.force
                             ? scene.sensor.force_full_scale_N
                             : 2.0 * std::max(plant.friction_N, scene.friction.largest_limit_N());
  design.scales = {1.0 / scene.drive->frequency_Hz, force_N, velocity_m_per_s,
                   scene.max_drive_force_N()};
  require_wide_range(velocity_m_per_s, fastest_m_per_s);
  return velocity_m_per_s / (scene.drive->rate_rad_per_s());
}

/// @return displacement amplitude at the velocity that is the base of all
double set_driven_scales(const scene::Scene& scene, const NominalPlant& plant, double room,
                         ControlDesign& design) {
  const double omega = scene.drive->rate_rad_per_s();
  require_settling(plant, omega);
  const double displacement_m =
      room * scene.max_drive_force_N() / dynamic_stiffness_N_per_m(plant, omega);
  design.scales = {1.0 / scene.drive->frequency_Hz, scene.sensor.force_full_scale_N,
                   displacement_m * omega, scene.max_drive_force_N()};
  return displacement_m;
}

/// @return displacement amplitude at the velocity that is the base of all
double set_scales(const scene::Scene& scene, const NominalPlant& plant, ControlDesign& design) {
  switch (scene.vibration_mode()) {
    case scene::VibrationMode::damped:
      return set_observed_scales(scene, plant, damped_range_m_per_s, design);
    case scene::VibrationMode::resonant:
      return set_observed_scales(scene, plant, resonant_range_m_per_s, design);
    case scene::VibrationMode::sensorless: {
      const double displacement_m = set_driven_scales(scene, plant, sensorless_room, design);
      require_sliding(scene, scene.sliding.fastest_m_per_s());
      return displacement_m;
    }
    case scene::VibrationMode::feedforward:
      break;
  }
  return set_driven_scales(scene, plant, 1.0, design);
}

}  // namespace

void design_scales(const scene::Scene& scene, const NominalPlant& plant, ControlDesign& design) {
  const double displacement_m = set_scales(scene, plant, design);
  design.scales.every_periods = scene.controller->every_periods;
  design.friction_force = per_unit(
      plant.friction_N, design.scales.force_N, smallest_friction, "sensor.force_full_scale_N",
      fmt::format("is {:.4g} N, of which the nominal friction force "
                  "of {:.4g} N makes {{:.3g}}",
                  design.scales.force_N, plant.friction_N),
      fmt::format("above {}, at most {} N", scene::at_least(plant.friction_N),
                  scene::at_most(plant.friction_N / smallest_friction)));
  design.contact_force = plant.contact_stiffness_N_per_m * displacement_m / design.scales.force_N;
  design.speed_floor = speed_floor(scene, plant, design.scales);
  check_converter(scene, plant);
  design.smallest_friction =
      std::max(smallest_friction, fewest_codes * code_N(scene.sensor) / design.scales.force_N);
}

}  // namespace sonoglide::configure
