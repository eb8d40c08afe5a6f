/// What a scene's solver says of itself, for those who do not compose it.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "host_sim/scene/scene.hpp"

namespace sonoglide::scene {

std::string_view name_of(SolverMethod method);

/// Whether it picks its own steps by a tolerance; the others take steps of a fixed length.
bool is_adaptive(SolverMethod method);

/// Whether it is adaptive, with a longest step that a scene may give.
bool takes_longest_step(SolverMethod method);

/// Whether a scene may choose its order.
bool takes_order(SolverMethod method);
std::vector<int> built_orders(SolverMethod method);

/// Whether it follows a drive of straight pieces.
bool follows_straight_drives(SolverMethod method);
/// The only order in which it does, of a method whose order a scene may choose.
std::optional<int> straight_order(SolverMethod method);

/// Whether it solves a [load] with its friction.
bool moves_load(SolverMethod method);

/// Whether it notices reversals, sticks and releases.
bool counts_events(SolverMethod method);

}  // namespace sonoglide::scene
