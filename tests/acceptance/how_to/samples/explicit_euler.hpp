/// Explicit Euler in a scene: the sample of "How to add a solver".
#pragma once

#include <array>
#include <string_view>

namespace sonoglide::plant {
template <class Model>
class ExplicitEuler;
}

namespace sonoglide::scene::solvers {

/// What the members mean is listed at solvers::EventTaylor.
struct ExplicitEuler {
  static constexpr std::string_view name = "explicit_euler";
  static constexpr bool adaptive = false;
  static constexpr bool takes_order = false;
  static constexpr std::array<int, 1> orders = {0};
  static constexpr std::array<int, 1> straight_orders = {0};
  static constexpr int order_for(double /*tolerance*/) { return 0; }
  static constexpr bool composed_lean = false;
  static constexpr bool counts_events = false;
  template <class Model, int /*Order*/>
  using Core = plant::ExplicitEuler<Model>;
};

}  // namespace sonoglide::scene::solvers
