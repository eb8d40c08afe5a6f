/// Points of a sweep to rows, each by the solver that suits it.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "host_sim/long_work/kept_points.hpp"
#include "host_sim/runs/batch/run_dahl_plants.hpp"
#include "host_sim/runs/run_many.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/studies/sweep/plan.hpp"
#include "host_sim/studies/sweep/row.hpp"

namespace sonoglide::sweep {

// One point of a sweep as the solver over SIMD lanes takes it.

struct BatchPoint {
  batch::DahlPlant plant;
  batch::RunLength length;
  batch::Accuracy accuracy = batch::Accuracy::fine;
};

/// Absent where the lanes cannot do the scene: they take open loop under a drive, Dahl friction,
/// constant sliding velocity, whole carrier periods in run and window, and event_taylor or event_gauss
/// with no order asked for and a tolerance of at least 1e-8. From 1e-4 on they compute in float32.
std::optional<BatchPoint> batch_point(const scene::Scene& scene);

/// @param run  solved
PointResult row_of(const BatchPoint& point, const batch::DahlRun& run);

/// Time to solve a point over the time to read it, right to a factor of about two: it serves the
/// progress shown while the points of a sweep are read, and nothing else.
double expected_solving_cost(const scene::Scene& scene);

/// The mean of these points.
double expected_solving_cost(const Plan& plan, const PointRange& points);

/// The mean of a figure over these points, as some from all over them have it. 0 where one of those
/// is unusable: reading all points will say which is the first.
/// @param samples  how many; >= 1
double mean_over(const Plan& plan, const PointRange& points, std::size_t samples,
                 const std::function<double(const scene::Scene&)>& figure);

/// A computation that fails gives a row whose status says why.
PointResult solve_scalar_point(const experiment::Experiment& experiment);

/// Takes finished points, from any thread.
using Sink = std::function<void(std::vector<Record>)>;

/// Points of a sweep read and checked, and divided among the solvers.
class Solve {
 public:
  /// The plan outlives this.
  /// @param pace  told of the points read; may be null
  /// @throws scene_file::SceneError  a point is unusable
  Solve(const Plan& plan, const PointRange& points, long_work::Pace* pace);

  /// These points as calls: those that suit SIMD lanes together with others of their length and
  /// accuracy, the others alone.
  runs::Calls calls(const runs::Places& points) const;

  /// Solves them on all threads: over SIMD lanes, or one by one as `run` does, which is also what
  /// becomes of points that the lanes give up. A row depends on its point alone, to the bit.
  void operator()(const runs::Calls& calls, const Sink& sink) const;

  /// As long work.
  void operator()(const runs::Places& points, const long_work::Sink& sink) const;

 private:
  const std::optional<BatchPoint>& batch(std::size_t point) const {
    return batch_points_[point - first_];
  }
  runs::Places over_lanes(const runs::Places& points, const Sink& sink) const;

  const Plan& plan_;
  std::size_t first_;
  std::vector<std::optional<BatchPoint>> batch_points_;  ///< from the first on; absent: no lanes
};

/// A whole sweep in memory, for whoever writes no file: the rows of every point, in the order of the
/// grid, as sweep.csv has them.
/// @param threads  0: one for each core
/// @throws scene_file::SceneError  a point is unusable; nothing was computed
std::vector<PointResult> compute_rows(const Plan& plan, unsigned threads);

}  // namespace sonoglide::sweep
