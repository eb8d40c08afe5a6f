/// The splitting method in a scene.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "host_sim/scene/stiff_core.hpp"

namespace sonoglide::plant {
template <class Model>
class Strang;
}  // namespace sonoglide::plant

namespace sonoglide::scene::solvers {

/// What the members mean is listed at solvers::EventTaylor.
struct Strang {
  static constexpr std::string_view name = "strang";
  static constexpr bool adaptive = true;
  static constexpr double default_tolerance = 1e-4;
  static constexpr bool takes_step = true;
  static constexpr bool takes_order = false;
  static constexpr std::array<int, 1> orders = {0};
  static constexpr std::array<int, 0> straight_orders = {};
  static constexpr int order_for(double /*tolerance*/) { return 0; }
  static constexpr bool composed_lean = true;
  static constexpr bool counts_events = true;
  // The tolerance bounds the energy, in which event_taylor errs by up to 13 of its tolerances.
  template <class Model, int /*Order*/>
  using Core = StiffCore<Model, plant::Strang<Model>, 64>;
};

}  // namespace sonoglide::scene::solvers
