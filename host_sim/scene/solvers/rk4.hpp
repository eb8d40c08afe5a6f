/// The paper's method in a scene.
#pragma once

#include <array>
#include <string_view>

namespace sonoglide::plant {
template <class Model>
class Rk4;
}

namespace sonoglide::scene::solvers {

/// What the members mean is listed at solvers::EventTaylor.
struct Rk4 {
  static constexpr std::string_view name = "rk4";
  static constexpr bool adaptive = false;
  static constexpr bool takes_order = false;
  static constexpr std::array<int, 1> orders = {0};
  static constexpr std::array<int, 1> straight_orders = {0};
  static constexpr int order_for(double /*tolerance*/) { return 0; }
  static constexpr bool composed_lean = false;
  static constexpr bool counts_events = false;
  template <class Model, int /*Order*/>
  using Core = plant::Rk4<Model>;
  template <class Model, int /*Order*/>
  using LoadedCore = plant::Rk4<Model>;
};

}  // namespace sonoglide::scene::solvers
