#include "host_sim/studies/sweep/solve.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "firmware/numeric/turn.hpp"
#include "host_sim/loop/plant/carrier_grid.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/process/thread_limit.hpp"
#include "host_sim/report/step_metrics.hpp"
#include "host_sim/report/texture_metrics.hpp"
#include "host_sim/report/words.hpp"
#include "host_sim/runs/lane_scene.hpp"
#include "host_sim/scene/solver_facts.hpp"
#include "host_sim/scene_file/scene_error.hpp"

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

double mean_over(const Plan& plan, const PointRange& points, std::size_t samples,
                 const std::function<double(const scene::Scene&)>& figure) try {
  // Multiples of the golden section fall into step with no axis.
  constexpr double golden = 0.61803398874989485;
  double sum = 0.0;
  for (std::size_t i = 0; i < samples; ++i) {
    const double part = std::fmod(golden * static_cast<double>(i), 1.0);
    const auto offset = static_cast<std::size_t>(part * static_cast<double>(points.size()));
    sum += figure(plan.experiment(points.first + offset).plant);
  }
  return sum / static_cast<double>(samples);
} catch (const scene_file::SceneError&) {
  return 0.0;
}

double expected_solving_cost(const Plan& plan, const PointRange& points) {
  constexpr std::size_t samples = 32;
  return mean_over(plan, points, samples,
                   [](const scene::Scene& scene) { return expected_solving_cost(scene); });
}

namespace {

void take_step(const report::StepMetrics& last, double size, PointResult& row) {
  row.settling_time_s = last.settling_time_s.value_or(PointResult::undefined);
  row.steady_error = last.steady_error * size;
  row.ripple = last.ripple * size;
  row.limit = last.limit;
}

/// The mean comes first, then the harmonics.
void take_texture(const std::vector<report::TextureHarmonic>& harmonics, double size,
                  PointResult& row) {
  const report::TextureHarmonic& mean = harmonics.front();
  row.texture_mean_error = (mean.rendered.real() - mean.wanted.real()) * size;
  const auto largest = std::max_element(
      harmonics.begin() + 1, harmonics.end(),
      [](const auto& a, const auto& b) { return std::abs(a.wanted) < std::abs(b.wanted); });
  if (largest != harmonics.end()) {
    row.texture_amplitude_ratio = largest->amplitude_ratio();
    row.texture_lag_deg = largest->lag_deg();
  }
}

PointResult run(const experiment::Experiment& experiment) {
  const scene::Scene& scene = experiment.plant;
  std::optional<report::StepMeter> steps;
  std::optional<report::TextureMeter> texture;
  loop::Watch watch;
  if (experiment.design && scene.controller->texture) {
    watch.periods.push_back(&texture.emplace(scene));
  } else if (experiment.design) {
    watch.periods.push_back(&steps.emplace(scene, *experiment.design));
  }
  const loop::RunResult result = loop::run(experiment, watch);
  const loop::PowerRatios window = loop::power_ratios(scene, result.window);
  PointResult row;
  row.friction_ratio_whole_run = loop::power_ratios(scene, result.whole).friction_ratio;
  row.friction_ratio_window = window.friction_ratio;
  row.dissipation_ratio_window = window.dissipation_ratio;
  if (scene.load) {
    row.load_final_velocity_m_per_s = result.final_state.load_velocity_m_per_s;
    row.load_final_displacement_m = result.final_load_displacement_m;
  }
  if (steps) {
    take_step(steps->steps().back(), report::target_unit(scene).size, row);
  } else if (texture) {
    take_texture(texture->harmonics(), report::target_unit(scene).size, row);
  }
  if (result.control) {
    const std::vector<loop::FaultEvent>& faults = result.control->faults;
    row.fault = faults.empty() ? control::Fault::none : faults.front().fault;
  }
  return row;
}

}  // namespace

PointResult solve_scalar_point(const experiment::Experiment& experiment) {
  try {
    return run(experiment);
  } catch (const loop::ComputationError& error) {
    PointResult failed;
    failed.status = report::one_line(error.what());
    return failed;
  }
}

Solve::Solve(const Plan& plan, const PointRange& points, long_work::Pace* pace)
    : plan_(plan), first_(points.first), batch_points_(points.size()) {
  if (pace != nullptr) {
    pace->begin(points.size(), expected_solving_cost(plan, points));
  }
  plan.visit(
      points,
      [this](std::size_t point, const experiment::Experiment& experiment) {
        batch_points_[point - first_] = batch_point(experiment.plant);
      },
      pace);
}

runs::Calls Solve::calls(const runs::Places& points) const {
  using Group = std::tuple<std::uint32_t, std::uint32_t, batch::Accuracy>;
  return runs::divide(points, [this](std::size_t point) -> std::optional<Group> {
    const std::optional<BatchPoint>& each = batch(point);
    if (!each) {
      return std::nullopt;
    }
    return Group{each->length.periods, each->length.window_start_periods, each->accuracy};
  });
}

void Solve::operator()(const runs::Calls& calls, const Sink& sink) const {
  runs::run_many(
      calls, [&](const runs::Places& points) { return over_lanes(points, sink); },
      [&](std::size_t point) {
        sink({{point, solve_scalar_point(plan_.experiment(point))}});
      });
}

void Solve::operator()(const runs::Places& points, const long_work::Sink& sink) const {
  (*this)(calls(points), [&sink](const std::vector<Record>& records) {
    sink(long_work::finished_points(records));
  });
}

/// @return what the lanes give up
runs::Places Solve::over_lanes(const runs::Places& points, const Sink& sink) const {
  std::vector<batch::DahlPlant> plants;
  for (const std::size_t point : points) {
    plants.push_back(batch(point)->plant);
  }
  const BatchPoint& any = *batch(points.front());
  const std::vector<batch::DahlRun> found =
      batch::run_dahl_plants(plants, any.length, any.accuracy);
  std::vector<Record> records;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (found[i].status == batch::RunStatus::solved) {
      records.push_back({points[i], row_of(*batch(points[i]), found[i])});
    }
  }
  sink(std::move(records));
  return runs::given_up(points, found);
}

std::vector<PointResult> compute_rows(const Plan& plan, unsigned threads) {
  const process::ThreadLimit limit(threads);
  const Solve solve(plan, plan.all(), nullptr);
  std::vector<PointResult> rows(plan.grid().size());
  runs::Places all(rows.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  solve(solve.calls(all), [&](std::vector<Record> records) {
    for (Record& record : records) {
      rows[record.point] = std::move(record.row);
    }
  });
  return rows;
}

}  // namespace sonoglide::sweep
