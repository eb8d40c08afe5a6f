/// A solver as a scene names it.
#pragma once

#include <cstddef>
#include <string_view>

namespace sonoglide::scene {

/// Its place in the list of solver_methods.hpp.
struct SolverMethod {
  std::size_t index = 0;
};

constexpr bool operator==(SolverMethod a, SolverMethod b) {
  return a.index == b.index;
}
constexpr bool operator!=(SolverMethod a, SolverMethod b) {
  return !(a == b);
}

std::string_view name_of(SolverMethod method);

/// Whether it picks its own steps by a tolerance; the others take steps of a fixed length.
bool is_adaptive(SolverMethod method);

/// Whether it notices reversals, sticks and releases.
bool counts_events(SolverMethod method);

}  // namespace sonoglide::scene
