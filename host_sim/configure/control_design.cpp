#include "host_sim/configure/control_design.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "host_sim/configure/calibration_design.hpp"
#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/configure/regulator_design.hpp"
#include "host_sim/configure/scales_design.hpp"
#include "host_sim/configure/supervision_design.hpp"

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

/// The loop that holds the vibration, and the regulator of the friction ratio around it.
void design_vibration(const scene::Scene& scene, const NominalPlant& plant, ControlDesign& design) {
  const double velocity_m_per_s = design.scales.velocity_m_per_s;
  switch (scene.vibration_mode()) {
    case scene::VibrationMode::feedforward:
      design.vibration = design_feedforward(scene, plant, design);
      return;
    case scene::VibrationMode::sensorless:
      design.vibration = design_sensorless(scene, plant, velocity_m_per_s);
      design_outer_regulator(scene, SensorlessDesign::following_periods, design);
      design.integral_gain = 0.0;  // the observer's constant is the integral
      return;
    case scene::VibrationMode::damped:
      design.vibration = design_damping(scene, plant, velocity_m_per_s);
      design_outer_regulator(scene, DampedDesign::following_periods, design);
      return;
    case scene::VibrationMode::resonant:
      design.vibration = design_resonance(scene, plant, velocity_m_per_s);
      design_outer_regulator(scene, ResonantDesign::following_periods, design);
      return;
  }
}

}  // namespace

ControlDesign design_control(const scene::Scene& any_scene) {
  const scene::Scene& scene = any_scene.nominal();
  const NominalPlant plant = nominal_plant(scene);
  ControlDesign design;
  design.map = scene::friction_map(scene.friction.law);
  design.senses_force = scene.sensor.force;
  design.relearns = scene.controller->relearn_every_s.has_value();
  design_scales(scene, plant, design);
  design_vibration(scene, plant, design);
  design_supervision(scene, plant, design);
  design_calibration(scene, plant, design);
  design_slew(*scene.drive, design);
  design_relearning(scene, plant, design);
  return design;
}

namespace {

/// Without a vibration sensor the vibration is known no better than the friction, which is therefore
/// learnt first.
double default_calibration_s(const scene::Scene& scene, const ControlDesign& design) {
  return design.in_mode<SensorlessDesign>() != nullptr ? shortest_calibration_s(scene, design)
                                                       : 0.0;
}

/// @param scene  what the controller knows, without true values
void fill_in(scene::Scene& scene, ControlDesign& design) {
  scene::Controller& controller = *scene.controller;
  if (controller.shaping == scene::Shaping::robust && !controller.shaping_range) {
    controller.shaping_range = default_shaping_range(scene.tolerances);
  }
  if (!controller.calibration_s) {
    controller.calibration_s = default_calibration_s(scene, design);
    design_calibration(scene, nominal_plant(scene), design);
  }
}

}  // namespace

std::optional<ControlDesign> complete(scene::Scene& scene) {
  if (!scene.controller) {
    return std::nullopt;
  }
  ControlDesign design = design_control(scene);
  if (!scene.nominal_scene) {
    fill_in(scene, design);
    return design;
  }
  scene::Scene nominal = scene.nominal();
  fill_in(nominal, design);
  scene.controller->shaping_range = nominal.controller->shaping_range;
  scene.controller->calibration_s = nominal.controller->calibration_s;
  scene.nominal_scene = std::make_shared<const scene::Scene>(std::move(nominal));
  return design;
}

std::optional<ControlDesign> design_if_closed(const scene::Scene& scene) {
  return scene.controller ? std::optional<ControlDesign>(design_control(scene)) : std::nullopt;
}

}  // namespace sonoglide::configure
