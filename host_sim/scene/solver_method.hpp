/// A solver as a scene names it.
#pragma once

#include <cstddef>

namespace sonoglide::scene {

/// Its place in the list of configure/solver_methods.hpp.
struct SolverMethod {
  std::size_t index = 0;
};

constexpr bool operator==(SolverMethod a, SolverMethod b) {
  return a.index == b.index;
}
constexpr bool operator!=(SolverMethod a, SolverMethod b) {
  return !(a == b);
}

}  // namespace sonoglide::scene
