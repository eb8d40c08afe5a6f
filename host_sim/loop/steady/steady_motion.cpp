#include "host_sim/loop/steady/requirement.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "host_sim/loop/plant/steady_orbit.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/loop/watch.hpp"
#include "host_sim/scene/friction_laws.hpp"

namespace sonoglide::steady {
namespace {

constexpr double samples_per_period = 720.0;
constexpr double solver_tolerance = 1e-12;

/// Half of peak to peak.
double amplitude(const std::vector<loop::PlantState>& states, double loop::PlantState::*member) {
  const auto [low, high] = std::minmax_element(
      states.begin(), states.end(),
      [&](const loop::PlantState& a, const loop::PlantState& b) { return a.*member < b.*member; });
  return 0.5 * ((*high).*member - (*low).*member);
}

}  // namespace

scene::Scene steady_scene(const scene::Scene& scene, double sliding_m_per_s, double drive_force_N) {
  scene::Scene steady;
  steady.name = scene.name;
  steady.plant = scene.plant;
  steady.plant.initial_displacement_m = 0.0;
  steady.plant.initial_velocity_m_per_s = 0.0;
  steady.friction = scene.friction;
  steady.friction.initial_force_N = 0.0;
  steady.transducer = scene.transducer;
  steady.sliding.profile = {{0.0, sliding_m_per_s}};
  steady.drive.emplace();
  steady.drive->frequency_Hz = scene.drive->frequency_Hz;
  steady.drive->force_amplitude_N = drive_force_N;
  steady.solver.tolerance = solver_tolerance;
  steady.run.start = scene::Start::steady;
  steady.run.duration_s = 1.0 / scene.drive->frequency_Hz;
  return steady;
}

namespace {

double ratio_on(const scene::Scene& scene, const loop::SteadyOrbit& orbit) {
  const double undriven_N = scene::undriven_friction_N(
      scene.friction.law, scene.friction, scene.sliding.profile.front().velocity_m_per_s);
  return orbit.energy.resistance_impulse_N_s / (undriven_N * orbit.energy.duration_s);
}

}  // namespace

double friction_ratio(const scene::Scene& steady_scene) {
  return ratio_on(steady_scene, loop::find_steady_orbit(steady_scene, most_steps));
}

double orbit_ratio(const scene::Scene& steady_scene) {
  return ratio_on(steady_scene, loop::find_orbit(steady_scene, most_steps));
}

SteadyMotion steady_motion(const scene::Scene& steady_scene) {
  const double period_s = steady_scene.run.duration_s;
  loop::Recording recording;
  loop::Watch watch;
  watch.samples.push_back({{0.0, period_s, period_s / samples_per_period}, &recording});
  const loop::RunResult result = loop::run(steady_scene, watch);
  const loop::EnergyBalance& energy = result.whole;
  const double force_N = steady_scene.drive_force_N();
  const double velocity_m_per_s = amplitude(recording.state, &loop::PlantState::velocity_m_per_s);
  const double sliding_m_per_s = steady_scene.sliding.profile.front().velocity_m_per_s;
  const double undriven_N =
      scene::undriven_friction_N(steady_scene.friction.law, steady_scene.friction, sliding_m_per_s);
  return {force_N,
          loop::power_ratios(steady_scene, energy).friction_ratio,
          amplitude(recording.state, &loop::PlantState::displacement_m),
          velocity_m_per_s,
          energy.drive_work_J / period_s,
          0.5 * force_N * velocity_m_per_s,
          energy.friction_work_J / period_s,
          undriven_N * std::abs(sliding_m_per_s),
          energy.damping_work_J / period_s,
          result.electrical ? std::optional(loop::electrical_figures(*result.electrical))
                            : std::nullopt};
}

}  // namespace sonoglide::steady
