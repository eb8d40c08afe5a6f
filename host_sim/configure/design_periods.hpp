/// What a controller's design waits for, in its periods.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/design_steps.hpp"
#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// Time constant of the sensor's low-pass.
inline double filter_periods(const scene::Scene& scene, const ControlScales& scales) {
  const std::optional<double> low_pass_Hz = scene.sensor.low_pass_Hz();
  return low_pass_Hz ? 1.0 / (numeric::two_pi * *low_pass_Hz * scales.step_period_s()) : 0.0;
}

inline std::uint16_t whole_periods(double periods) {
  constexpr double most = 60000.0;
  return static_cast<std::uint16_t>(std::min(most, std::ceil(periods)));
}

/// From a request to the reading of the carrier period that it acts in. A reading is that of the last
/// carrier period of a step.
inline double latency_periods(const scene::Scene& scene) {
  const int carriers = 1 + scene.drive->delay_periods + scene.sensor.delay_periods;
  const int every = scene.controller->every_periods;
  const int steps = (carriers + every - 1) / every;
  return steps;
}

/// Until the contact has forgotten.
inline double contact_settling_periods(const scene::Scene& scene) {
  constexpr double carriers = 2.0;
  return carriers / scene.controller->every_periods;
}

/// 1/n, below 1: fixed point ends there.
inline double mean_weight(double samples) {
  return std::min(1.0 / samples, 1.0 - resolution(scene::Arithmetic::q31));
}

inline constexpr double least_presliding_travels = 7.0;  // 0.1 % of the force is left
inline constexpr double usual_presliding_travels = 2.0 * least_presliding_travels;

/// Periods in which the contact slides through its presliding travel, so many times, and
/// the sensor settles.
double settling_periods(const scene::Scene& scene, const NominalPlant& plant,
                        const ControlDesign& design, double presliding_travels);

/// Of the undriven force, whose mean their noise moves by no more than 0.25 % rms; at most 16.
double readings_for_mean(const scene::Scene& scene, const NominalPlant& plant);

}  // namespace sonoglide::configure
