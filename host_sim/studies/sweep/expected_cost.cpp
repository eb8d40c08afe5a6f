#include "host_sim/studies/sweep/expected_cost.hpp"

#include <cmath>
#include <cstddef>

#include "host_sim/configure/solver_facts.hpp"
#include "host_sim/scene_file/scene_error.hpp"
#include "host_sim/studies/sweep/batch_point.hpp"

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
  return configure::is_adaptive(scene.solver.method)
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

double expected_solving_cost(const Plan& plan) try {
  constexpr int samples = 32;
  // Multiples of the golden section fall into step with no axis.
  constexpr double golden = 0.61803398874989485;
  double sum = 0.0;
  for (int i = 0; i < samples; ++i) {
    const double part = std::fmod(golden * i, 1.0);
    sum += expected_solving_cost(
        plan.scene(static_cast<std::size_t>(part * static_cast<double>(plan.grid().size()))));
  }
  return sum / samples;
} catch (const scene_file::SceneError&) {
  return 0.0;  // reading all points will say which is the first that is unusable
}

}  // namespace sonoglide::sweep
