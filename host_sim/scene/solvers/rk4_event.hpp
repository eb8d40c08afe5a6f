/// The paper's method with its steps split at the reversals in a scene.
#pragma once

#include <array>
#include <string_view>

namespace sonoglide::plant {
template <class Model>
class Rk4Event;
}

namespace sonoglide::scene::solvers {

/// What the members mean is listed at solvers::EventTaylor.
struct Rk4Event {
  static constexpr std::string_view name = "rk4_event";
  static constexpr bool adaptive = false;
  static constexpr bool takes_order = false;
  static constexpr std::array<int, 1> orders = {0};
  static constexpr std::array<int, 0> straight_orders = {};
  static constexpr int order_for(double /*tolerance*/) { return 0; }
  static constexpr bool composed_lean = false;
  static constexpr bool counts_events = true;
  template <class Model, int /*Order*/>
  using Core = plant::Rk4Event<Model>;
};

}  // namespace sonoglide::scene::solvers
