/// A whole sweep in memory, for whoever writes no file.
#pragma once

#include <vector>

#include "host_sim/studies/sweep/plan.hpp"
#include "host_sim/studies/sweep/row.hpp"

namespace sonoglide::sweep {

/// The rows of every point, in the order of the grid, as sweep.csv has them.
/// @param threads  0: one for each core
/// @throws scene_file::SceneError  a point is unusable; nothing was computed
std::vector<PointResult> compute_rows(const Plan& plan, unsigned threads);

}  // namespace sonoglide::sweep
