#include "host_sim/loop/run.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/engine.hpp"

namespace sonoglide::loop {
namespace {

/// Progress is told this often, and once in so many carrier periods of a long run.
constexpr std::uint64_t progress_calls = 500;
constexpr std::uint64_t most_periods_untold = 10000;

/// By one carrier period.
void advance(const scene::Scene& scene, Engine& engine) {
  const std::optional<ControlRun>& control = engine.control();
  if (control && control->leads_frequency()) {
    engine.set_frequency_Hz(control->frequency_Hz());
  } else if (scene.drive && !scene.drive->frequency_profile.empty()) {
    engine.set_frequency_Hz(
        configure::carrier_frequency_Hz(*scene.drive, engine.clock().begin_s()));
  }
  const double open_loop_N = scene.drive ? scene.drive_force_N() : 0.0;
  const double amplitude_N = control ? control->amplitude_N() : open_loop_N;
  PlantPeriod period = engine.move(amplitude_N, control ? control->bias_N() : 0.0);
  engine.conclude(period);
}

RunResult simulate(const scene::Scene& scene, ControlPort* controller, const Watch& watch,
                   RunResult result) {
  const auto begin = std::chrono::steady_clock::now();
  Engine engine(scene, true, controller, watch, result);
  const std::uint64_t tell_every =
      std::min(CarrierGrid(scene).count() / progress_calls + 1, most_periods_untold);
  for (std::uint64_t k = 0; !engine.clock().over(); ++k) {
    if (watch.progress && k % tell_every == 0) {
      watch.progress(engine.clock().begin_s() / scene.run.duration_s);
    }
    advance(scene, engine);
  }
  engine.finish();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  result.wall_s = wall.count();
  return result;
}

}  // namespace

RunResult run(const scene::Scene& scene, const Watch& watch) {
  return run(configure::make_experiment(scene), watch);
}

RunResult run(const configure::Experiment& experiment, const Watch& watch) {
  return run(experiment.plant, experiment.design, watch);
}

RunResult run(const scene::Scene& plant, const std::optional<configure::ControlDesign>& design,
              const Watch& watch) {
  if (!design) {
    return simulate(plant, nullptr, watch, {});
  }
  const auto controller = make_control_port(plant, *design);
  return run(plant, *design, *controller, watch);
}

RunResult run(const scene::Scene& plant, const configure::ControlDesign& design,
              ControlPort& controller, const Watch& watch) {
  return simulate(plant, &controller, watch, begun_result(design));
}

}  // namespace sonoglide::loop
