#include "host_sim/configure/control_design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <variant>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/design_steps.hpp"
#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/scene/bound.hpp"

// The elementary functions of a design are the core's own, so that a scene gives the same
// parameters, bit for bit, on every machine.

namespace sonoglide::configure {
namespace {

template <scene::VibrationMode Mode>
using DesignOf =
    std::variant_alternative_t<static_cast<std::size_t>(Mode), decltype(ControlDesign::vibration)>;
static_assert(std::is_same_v<DesignOf<scene::VibrationMode::feedforward>, FeedforwardDesign> &&
              std::is_same_v<DesignOf<scene::VibrationMode::sensorless>, SensorlessDesign> &&
              std::is_same_v<DesignOf<scene::VibrationMode::damped>, DampedDesign> &&
              std::is_same_v<DesignOf<scene::VibrationMode::resonant>, ResonantDesign>);

/// @throws ConfigurationError  the sensor does not read a force that is the target, or the controller
///         takes it for 0
void require_readable_targets(const scene::Scene& scene, const ControlDesign& design) {
  const scene::Controller& controller = *scene.controller;
  const double least_N = design.scales.force_N * resolution(controller.arithmetic);
  for (const double target : controller.target_values()) {
    if (controller.holds_force() && !(target < design.scales.force_N)) {
      throw ConfigurationError(
          fmt::format("controller.{}", controller.target_key()),
          fmt::format(
              "{:g} N is not below sensor.force_full_scale_N, {:g} N; allowed: at most {} N",
              target, design.scales.force_N, scene::at_most(design.scales.force_N)));
    }
    if (controller.holds_force() && target < least_N) {
      throw ConfigurationError(
          fmt::format("controller.{}", controller.target_key()),
          fmt::format(
              "{:g} N is less than the controller's arithmetic resolves of a force, {:.3g} N; "
              "allowed: at least {} N",
              target, least_N, scene::at_least(least_N)));
    }
  }
}

/// The loop that holds the vibration, and the regulator of the friction ratio around it.
void design_vibration(const scene::Scene& scene, const NominalPlant& plant, ControlDesign& design) {
  const double velocity_m_per_s = design.scales.velocity_m_per_s;
  switch (scene.vibration_mode()) {
    case scene::VibrationMode::feedforward:
      design.vibration = design_feedforward(scene, plant, design);
      return;
    case scene::VibrationMode::sensorless:
      design.vibration = design_sensorless(scene, plant, velocity_m_per_s);
      design_outer_regulator(scene, plant, SensorlessDesign::following_periods, design);
      design.integral_gain = 0.0;  // the observer's constant is the integral
      return;
    case scene::VibrationMode::damped:
      design.vibration = design_damping(scene, plant, velocity_m_per_s);
      design_outer_regulator(scene, plant, DampedDesign::following_periods, design);
      return;
    case scene::VibrationMode::resonant:
      design.vibration = design_resonance(scene, plant, velocity_m_per_s);
      design_outer_regulator(scene, plant, ResonantDesign::following_periods, design);
      return;
  }
}

/// @pre the vibration is designed
void design_bias(const scene::Scene& scene, const NominalPlant& plant, ControlDesign& design) {
  const auto* sensorless = design.in_mode<SensorlessDesign>();
  if (scene.drive->bias_limit_N > 0.0 && sensorless != nullptr && !sensorless->apart) {
    throw ConfigurationError(
        "drive.bias_limit_N",
        "is of no use: no reading of the friction tells a natural mode within 0.5 % of the carrier "
        "frequency from 0; allowed: 0, or a sensor.vibration");
  }
  if (scene.drive->bias_limit_N > 0.0 && scene.controller->arithmetic == scene::Arithmetic::q15) {
    throw ConfigurationError("controller.arithmetic",
                             "\"q15\" is too coarse for drive.bias_limit_N; allowed: \"float32\", "
                             "\"q31\", \"float64\"");
  }
  if (scene.drive->bias_limit_N > 0.0) {
    design.bias =
        design_bias(scene, plant, nominal_resonator(scene, plant, design.scales.velocity_m_per_s),
                    design.scales.force_N);
  }
}

void design_map(const scene::Scene& scene, const NominalPlant& plant, ControlDesign& design) {
  design.map = scene::friction_map(scene.friction.law);
  if (!is_tabulated(scene)) {
    return;
  }
  design.inverse = design_inverse(scene, plant);
  for (const double target : plant.target_ratios(*scene.controller)) {
    if (target < design.inverse->least_ratio.value_or(0.0)) {
      design.unreachable_ratio = std::min(target, design.unreachable_ratio.value_or(target));
    }
  }
}

}  // namespace

ControlDesign design_control(const scene::Scene& scene) {
  const NominalPlant plant = nominal_plant(scene);
  ControlDesign design;
  design.carrier_Hz = scene.drive->frequency_Hz;
  if (scene.transducer) {
    design.force_factor_N_per_V = scene.transducer->force_factor_N_per_V * plant.force_factor;
  }
  design.senses_force = scene.sensor.force;
  design.holds_force = scene.controller->holds_force();
  design.relearns = scene.controller->relearn_every_s.has_value();
  design_map(scene, plant, design);
  design_scales(scene, plant, design);
  require_readable_targets(scene, design);
  design_vibration(scene, plant, design);
  design_bias(scene, plant, design);
  design_supervision(scene, plant, design);
  design_calibration(scene, plant, design);
  design_slew(*scene.drive, design);
  design_relearning(scene, plant, design);
  design_tracking(scene, plant, design);
  design_texture(scene, design);
  return design;
}

}  // namespace sonoglide::configure
