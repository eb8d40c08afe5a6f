#include "host_sim/studies/sweep/batch_point.hpp"

#include <cmath>
#include <cstdint>

#include "firmware/numeric/turn.hpp"
#include "host_sim/loop/carrier_grid.hpp"
#include "host_sim/runs/lane_scene.hpp"

namespace sonoglide::sweep {
namespace {

constexpr double map_tolerance = 1e-4;
constexpr double fine_tolerance = 1e-8;

}  // namespace

std::optional<BatchPoint> batch_point(const scene::Scene& scene) {
  const std::optional<batch::DahlPlant> plant = runs::lane_plant(scene);
  if (!plant || scene.controller || scene.solver.tolerance < fine_tolerance) {
    return std::nullopt;
  }
  const loop::CarrierGrid grid(scene);
  const auto periods = grid.whole_periods(scene.run.duration_s);
  const auto window_start = grid.whole_periods(scene.run.window_start_s);
  constexpr std::uint64_t most_periods = 0xffffffff;
  if (!periods || !window_start || *window_start >= *periods || *periods > most_periods) {
    return std::nullopt;
  }
  return BatchPoint{
      *plant,
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
