/// One point of a sweep, computed as `run` computes it.
#pragma once

#include "host_sim/scene/scene.hpp"
#include "host_sim/studies/sweep/row.hpp"

namespace sonoglide::sweep {

/// A computation that fails gives a row whose status says why.
Row solve_scalar_point(const scene::Scene& scene);

}  // namespace sonoglide::sweep
