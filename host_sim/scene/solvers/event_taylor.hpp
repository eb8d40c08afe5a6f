/// The event-located Taylor solver in a scene, and the list of what every solver tells the
/// workstation program.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "host_sim/scene/stiff_core.hpp"

namespace sonoglide::scene::solvers {

/// A solver, named as its file and as the core's `firmware/plant/*/NAME.hpp`, has:
///   name               its word in a scene: solver.method = "..."
///   adaptive           true if it picks its own steps by the key `tolerance`; if false it requires
///                      the key `step_s`
///   default_tolerance  of an adaptive solver
///   takes_step         true if an adaptive solver accepts `step_s` as its longest step
///   takes_order        true if it accepts the key `order`, one of `orders`
///   orders             those that are built; {0} if the solver has only one order
///   straight_orders    those that are built for a drive of straight pieces
///   order_for(tolerance)  the order that takes the least time
///   composed_lean      true if common scenes have compositions of their own, without damping or
///                      sliding acceleration where a scene has none; false: one for all scenes
///   counts_events      true if it notices reversals, sticks and releases
///   LoadedCore<Model, Order>  only if it solves a [load]: the solver of the core for a plant::LoadedModel
///   Core<Model, Order> the solver of the core, declared only; which laws it takes that says itself
struct EventTaylor {
  static constexpr std::string_view name = "event_taylor";
  static constexpr bool adaptive = true;
  static constexpr double default_tolerance = 1e-10;
  static constexpr bool takes_step = false;
  static constexpr bool takes_order = true;
  static constexpr std::array<int, 3> orders = {8, 12, 16};
  static constexpr std::array<int, 1> straight_orders = {16};
  static constexpr int order_for(double tolerance) {
    return tolerance >= 1e-5 ? 8 : tolerance >= 1e-8 ? 12 : 16;
  }
  static constexpr bool composed_lean = true;
  static constexpr bool counts_events = true;
  template <class Model, int Order>
  using Core = StiffCore<Model, plant::EventTaylor<Model, static_cast<std::size_t>(Order)>, 1>;
  template <class Model, int Order>
  using LoadedCore = plant::EventTaylor<Model, static_cast<std::size_t>(Order)>;
};

}  // namespace sonoglide::scene::solvers
