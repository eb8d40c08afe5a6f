/// Points of a sweep to rows, each by the solver that suits it.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "host_sim/sweep/batch_point.hpp"
#include "host_sim/sweep/plan.hpp"
#include "host_sim/sweep/record.hpp"

namespace sonoglide::sweep {

/// Takes finished points, from any thread.
using Sink = std::function<void(std::vector<Record>)>;

/// Every point of a sweep read and checked, and divided among the solvers.
class Solve {
 public:
  /// The plan outlives this.
  /// @param pace  told of the points read
  /// @throws scene::SceneError  a point is unusable
  Solve(const Plan& plan, Pace& pace);

  /// How many points are worth solving in one call.
  std::size_t points_per_call() const;

  /// Solves these points: those that suit them over SIMD lanes, the others, and those that the
  /// lanes give up, one by one as `run` does. A row depends on its point alone, to the bit. Safe to
  /// call from several threads.
  void operator()(const std::vector<std::size_t>& points, const Sink& sink) const;

 private:
  const Plan& plan_;
  std::vector<std::optional<BatchPoint>> batch_points_;  ///< of each point; absent: no lanes
};

}  // namespace sonoglide::sweep
