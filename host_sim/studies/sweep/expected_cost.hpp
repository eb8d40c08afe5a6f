/// A guess of what solving takes, before anything is solved.
#pragma once

#include "host_sim/scene/scene.hpp"
#include "host_sim/studies/sweep/plan.hpp"

namespace sonoglide::sweep {

/// Time to solve a point over the time to read it, right to a factor of about two: it serves the
/// progress shown while the points of a sweep are read, and nothing else.
double expected_solving_cost(const scene::Scene& scene);

/// The mean of all points, as a few from all over the sweep have it.
double expected_solving_cost(const Plan& plan);

}  // namespace sonoglide::sweep
