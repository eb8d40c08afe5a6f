#include "host_sim/loop/plant/make_plant_port.hpp"

#include <variant>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/plant/changing_plant.hpp"
#include "host_sim/loop/plant/plant_description.hpp"
#include "host_sim/scene/solver_methods.hpp"

namespace sonoglide::loop {
namespace {

/// Where the friction is none, event_gauss has nothing to cut at reversals, and event_taylor's one
/// step in a period takes its place.
scene::Scene with_acting_solver(scene::Scene scene) {
  if (scene.solver.method == scene::method_of<scene::solvers::EventGauss> &&
      scene.friction.limit_N() == 0.0) {
    scene.solver.method = scene::method_of<scene::solvers::EventTaylor>;
    scene.solver.order.reset();
  }
  return scene;
}

}  // namespace

std::unique_ptr<PlantPort> make_plant_port(const scene::Scene& scene) {
  if (scene.profile_key() != nullptr || scene.carrier_changes()) {
    return std::make_unique<ChangingPlant>(scene);
  }
  const scene::Scene acting = with_acting_solver(scene);
  const PlantDescription description(acting);
  return std::visit(
      [&](const auto& law) {
        return scene.load ? make_loaded_plant(description, law) : make_law_plant(description, law);
      },
      configure::acting_law(scene.friction));
}

}  // namespace sonoglide::loop
