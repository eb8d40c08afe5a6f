/// Which friction laws a solver method is made for.
#pragma once

#include "host_sim/scene/scene.hpp"

namespace sonoglide::scene {

/// As the solvers of the core say themselves.
bool solves(SolverMethod method, const FrictionLaw& law);

}  // namespace sonoglide::scene
