/// What a scene's solver says of itself, for those who do not compose it.
#pragma once

#include <string_view>

#include "host_sim/scene/friction_laws.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

std::string_view name_of(scene::SolverMethod method);

/// Whether it picks its own steps by a tolerance; the others take steps of a fixed length.
bool is_adaptive(scene::SolverMethod method);

/// Whether it notices reversals, sticks and releases.
bool counts_events(scene::SolverMethod method);

/// Whether it takes the law, as the solver of the core says itself.
bool solves(scene::SolverMethod method, const scene::FrictionLaw& law);

}  // namespace sonoglide::configure
