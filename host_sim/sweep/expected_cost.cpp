#include "host_sim/sweep/expected_cost.hpp"

#include "host_sim/sweep/batch_point.hpp"

namespace sonoglide::sweep {
namespace {

// Measured near Table 1, in times that it takes to read a scene.
constexpr double map_period = 0.06;
constexpr double fine_period = 0.25;
constexpr double adaptive_period = 1.0;
constexpr double fixed_step = 0.03;
constexpr double control_period = 1.0;

double periods_of(const scene::Scene& scene) {
  return scene.drive ? scene.run.duration_s * scene.drive->frequency_Hz : 1.0;
}

double plant_cost(const scene::Scene& scene) {
  return scene::is_adaptive(scene.solver.method)
             ? adaptive_period * periods_of(scene)
             : fixed_step * scene.run.duration_s / scene.solver.step_s;
}

}  // namespace

double expected_solving_cost(const scene::Scene& scene) {
  if (const auto batch = batch_point(scene)) {
    return batch->length.periods *
           (batch->accuracy == batch::Accuracy::map ? map_period : fine_period);
  }
  return plant_cost(scene) + (scene.controller ? control_period * periods_of(scene) : 0.0);
}

}  // namespace sonoglide::sweep
