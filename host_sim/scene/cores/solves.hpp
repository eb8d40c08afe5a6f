#pragma once

#include "host_sim/scene/friction_laws.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::scene {

/// Whether a solver takes a law, as the solver of the core says itself.
bool solves(SolverMethod method, const FrictionLaw& law);

}  // namespace sonoglide::scene
