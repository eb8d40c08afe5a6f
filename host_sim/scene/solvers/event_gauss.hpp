/// The solver for weakly coupled contacts in a scene.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "host_sim/scene/stiff_core.hpp"

namespace sonoglide::plant {
template <class Model, std::size_t Nodes>
class EventGauss;
}  // namespace sonoglide::plant

namespace sonoglide::scene::solvers {

/// What the members mean is listed at solvers::EventTaylor.
struct EventGauss {
  static constexpr std::string_view name = "event_gauss";
  static constexpr bool adaptive = true;
  static constexpr double default_tolerance = 1e-10;
  static constexpr bool takes_step = false;
  static constexpr bool takes_order = false;
  static constexpr std::array<int, 2> orders = {8, 12};  // nodes
  static constexpr std::array<int, 0> straight_orders = {};
  static constexpr int order_for(double tolerance) { return tolerance >= 1e-8 ? 8 : 12; }
  static constexpr bool composed_lean = true;
  static constexpr bool counts_events = true;
  template <class Model, int Order>
  using Core = StiffCore<Model, plant::EventGauss<Model, static_cast<std::size_t>(Order)>, 1>;
};

}  // namespace sonoglide::scene::solvers
