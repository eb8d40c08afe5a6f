/// A guess of what solving takes, before anything is solved.
#pragma once

#include "host_sim/scene/scene.hpp"

namespace sonoglide::sweep {

/// Time to solve a point over the time to read it, right to a factor of about two: it serves the
/// progress shown while the points of a sweep are read, and nothing else.
double expected_solving_cost(const scene::Scene& scene);

}  // namespace sonoglide::sweep
