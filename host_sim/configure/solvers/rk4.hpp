/// The paper's method in a scene.
#pragma once

#include <array>
#include <string_view>

#include "host_sim/configure/study_terms.hpp"

namespace sonoglide::plant {
template <class Model>
class Rk4;
}

namespace sonoglide::configure::solvers {

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

  static constexpr Palette palette = Palette::green;
  static constexpr std::array<Sweep, 1> float64_sweeps = {{{0, 1, 5}}};
  static constexpr std::array<Sweep, 1> float32_sweeps = {{{0, 1, 4}}};
  static constexpr std::array<TrialOrders, 1> trial_orders = {{{0, 0}}};
  static constexpr TrialSettings trial_settings = {200.0, 200.0};
  static constexpr bool exact_bound = false;
};

}  // namespace sonoglide::configure::solvers
