#include "host_sim/studies/sweep/batch_point.hpp"

#include <cmath>
#include <cstdint>

#include "firmware/numeric/turn.hpp"
#include "firmware/plant/taylor/step_share.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/configure/solver_methods.hpp"
#include "host_sim/loop/carrier_grid.hpp"

namespace sonoglide::sweep {
namespace {

constexpr double map_tolerance = 1e-4;
constexpr double fine_tolerance = 1e-8;

bool suits_lanes(const scene::Scene& scene) {
  const scene::Solver& solver = scene.solver;
  return !scene.controller && scene.run.start == scene::Start::given && scene.drive &&
         scene.drive->waveform == scene::Waveform::cosine &&
         scene::is<scene::laws::Dahl>(scene.friction.law) && scene.friction.limit_N() > 0.0 &&
         scene.profile_key() == nullptr && scene.sliding.profile.size() == 1 &&
         solver.method == configure::method_of<configure::solvers::EventTaylor> && !solver.order &&
         solver.tolerance >= fine_tolerance;
}

/// The lanes take steps of one share of their tolerance.
bool adds_up_errors(const batch::DahlPlant& plant) {
  return plant::step_share(plant.stiffness, plant::Drift::of_velocity) < 1.0;
}

batch::DahlPlant plant_of(const scene::Scene& scene) {
  const scene::PlantScales scales = configure::plant_scales(scene);
  const configure::PlantNumbers numbers = configure::plant_numbers(scene, scales);
  batch::DahlPlant plant;
  plant.drive_amplitude = scene.drive->force_amplitude_N / scales.force_N;
  plant.damping = numbers.damping;
  plant.stiffness = numbers.stiffness;
  plant.friction_force = numbers.friction_force;
  plant.contact_stiffness = numbers.contact_stiffness;
  plant.sliding_velocity =
      scene.sliding.profile.front().velocity_m_per_s / scales.velocity_m_per_s();
  plant.vibration_sign = configure::vibration_sign(scene.friction.sign_convention);
  plant.initial = configure::initial_state(scene, scales);
  return plant;
}

}  // namespace

std::optional<BatchPoint> batch_point(const scene::Scene& scene) {
  if (!suits_lanes(scene)) {
    return std::nullopt;
  }
  const loop::CarrierGrid grid(scene);
  const auto periods = grid.whole_periods(scene.run.duration_s);
  const auto window_start = grid.whole_periods(scene.run.window_start_s);
  constexpr std::uint64_t most_periods = 0xffffffff;
  if (!periods || !window_start || *window_start >= *periods || *periods > most_periods) {
    return std::nullopt;
  }
  const batch::DahlPlant plant = plant_of(scene);
  if (adds_up_errors(plant)) {
    return std::nullopt;
  }
  return BatchPoint{
      plant,
      {static_cast<std::uint32_t>(*periods), static_cast<std::uint32_t>(*window_start)},
      scene.solver.tolerance >= map_tolerance ? batch::Accuracy::map : batch::Accuracy::fine};
}

PointResult row_of(const BatchPoint& point, const batch::DahlRun& run) {
  const double sliding = point.plant.sliding_velocity;
  const double direction = sliding < 0.0 ? -1.0 : 1.0;
  const double window =
      numeric::two_pi * (point.length.periods - point.length.window_start_periods);
  PointResult row;
  row.friction_ratio_whole_run = direction * run.whole.friction_ratio;
  row.friction_ratio_window = direction * run.window.friction_ratio;
  row.dissipation_ratio_window = sliding == 0.0
                                     ? PointResult::undefined
                                     : run.window.friction_work / (std::abs(sliding) * window);
  return row;
}

}  // namespace sonoglide::sweep
