/// The event-located Taylor solver in a scene, and the list of what every solver tells the
/// workstation program.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "host_sim/configure/study_terms.hpp"

namespace sonoglide::plant {
template <class Model, std::size_t Order>
class EventTaylor;
template <class Solver, class Turning, int Strictness>
class StiffLinear;
}  // namespace sonoglide::plant

namespace sonoglide::configure::solvers {

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
///   Core<Model, Order> the solver of the core, declared only; which laws it takes that says itself
/// and for the studies of solvers:
///   palette            colours of its curves in `work-precision`, shared with others like it
///   float64_sweeps, float32_sweeps  its settings there
///   trial_orders       a row of `stability` for each
///   trial_settings     tolerance, or steps per carrier period, for the random scenes
///   exact_bound        true if |F| <= Fc holds exactly, false if to rounding
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
  using Core = plant::StiffLinear<plant::EventTaylor<Model, static_cast<std::size_t>(Order)>,
                                  plant::EventTaylor<Model, 16>, 1>;

  static constexpr Palette palette = Palette::blue;
  static constexpr std::array<Sweep, 4> float64_sweeps = {
      {{8, 1, 14}, {12, 1, 15}, {16, 1, 15}, {20, 1, 15}}};
  static constexpr std::array<Sweep, 2> float32_sweeps = {{{8, 1, 7}, {12, 1, 7}}};
  static constexpr std::array<TrialOrders, 3> trial_orders = {{{8, 8}, {12, 12}, {16, 16}}};
  static constexpr TrialSettings trial_settings = {1e-10, 1e-6};
  static constexpr bool exact_bound = true;
};

}  // namespace sonoglide::configure::solvers
