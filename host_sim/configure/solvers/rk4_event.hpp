/// The paper's method with its steps split at the reversals in a scene.
#pragma once

#include <array>
#include <string_view>

#include "host_sim/configure/study_terms.hpp"

namespace sonoglide::plant {
template <class Model>
class Rk4Event;
}

namespace sonoglide::configure::solvers {

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

  static constexpr Palette palette = Palette::green;
  static constexpr std::array<Sweep, 1> float64_sweeps = {{{0, 1, 4}}};
  static constexpr std::array<Sweep, 1> float32_sweeps = {{{0, 1, 4}}};
  static constexpr std::array<TrialOrders, 1> trial_orders = {{{0, 0}}};
  static constexpr TrialSettings trial_settings = {200.0, 200.0};
  static constexpr bool exact_bound = false;
};

}  // namespace sonoglide::configure::solvers
