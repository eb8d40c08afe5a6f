#include "host_sim/configure/experiment.hpp"

#include <utility>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/design_steps.hpp"
#include "host_sim/configure/nominal_plant.hpp"

namespace sonoglide::configure {
namespace {

/// As controller.friction says. Without a vibration sensor the vibration is known no better than the
/// friction, which is therefore learnt first.
double default_calibration_s(const scene::Scene& scene, const ControlDesign& design) {
  const std::optional<scene::FrictionSource>& source = scene.controller->friction;
  if (source == scene::FrictionSource::calibrated) {
    const double calibration_s = shortest_calibration_s(scene, design);
    if (calibration_s <= 0.0) {
      throw ConfigurationError(
          "controller.friction",
          "\"calibrated\", but half of the first target's time is too short for "
          "it, or no sliding lasts as long; allowed: a controller.calibration_s "
          "of your own, or \"trusted\"");
    }
    return calibration_s;
  }
  return !source && design.in_mode<SensorlessDesign>() != nullptr
             ? shortest_calibration_s(scene, design)
             : 0.0;
}

/// Values that are absent and follow from the design.
void fill_in(scene::Scene& scene, ControlDesign& design) {
  scene::Controller& controller = *scene.controller;
  const auto* fed_forward = design.in_mode<FeedforwardDesign>();
  if (fed_forward != nullptr && fed_forward->shaping_range > 0.0) {
    controller.shaping_range = fed_forward->shaping_range;
  }
  if (!controller.calibration_s) {
    controller.calibration_s = default_calibration_s(scene, design);
    design_calibration(scene, nominal_plant(scene), design);
  }
}

}  // namespace

Experiment make_experiment(scene::Scene stated, std::optional<scene::Scene> plant) {
  Experiment experiment{plant ? std::move(*plant) : stated, std::move(stated), std::nullopt};
  scene::Scene& nominal = experiment.nominal;
  if (nominal.controller) {
    experiment.design = design_control(nominal);
    fill_in(nominal, *experiment.design);
    experiment.plant.controller = nominal.controller;
  }
  return experiment;
}

}  // namespace sonoglide::configure
