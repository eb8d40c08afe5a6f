/// With which settings the product's solvers are tried, and on how many scenes of each law.
#pragma once

#include <array>

#include "host_sim/scene/friction_laws.hpp"
#include "host_sim/scene/solver_methods.hpp"

namespace sonoglide::stability {

/// The orders that one row of the study takes in each arithmetic; 0 where the solver has but one.
struct TrialOrders {
  int float64;
  int float32;
};

/// For the random scenes: a tolerance, or a number of steps for each carrier period, in each
/// arithmetic.
struct TrialSettings {
  double float64;
  double float32;
};

/// Every solver has its own:
///   orders       a row of the study for each
///   extreme      for the random scenes
///   exact_bound  true if |F| <= Fc holds exactly, false if to rounding
template <class Described>
struct Settings;

template <>
struct Settings<scene::solvers::EventTaylor> {
  static constexpr std::array<TrialOrders, 3> orders = {{{8, 8}, {12, 12}, {16, 16}}};
  static constexpr TrialSettings extreme = {1e-10, 1e-6};
  static constexpr bool exact_bound = true;
};

template <>
struct Settings<scene::solvers::EventGauss> {
  // With the nodes that suit the tolerances below.
  static constexpr std::array<TrialOrders, 1> orders = {{{12, 8}}};
  static constexpr TrialSettings extreme = {1e-10, 1e-6};
  static constexpr bool exact_bound = true;
};

template <>
struct Settings<scene::solvers::Strang> {
  static constexpr std::array<TrialOrders, 1> orders = {{{0, 0}}};
  // Over the periods of a random scene the balance then keeps below what is allowed.
  static constexpr TrialSettings extreme = {1.6e-7, 1e-3};
  static constexpr bool exact_bound = true;
};

template <>
struct Settings<scene::solvers::Rk4> {
  static constexpr std::array<TrialOrders, 1> orders = {{{0, 0}}};
  static constexpr TrialSettings extreme = {200.0, 200.0};
  static constexpr bool exact_bound = false;
};

template <>
struct Settings<scene::solvers::Rk4Event> {
  static constexpr std::array<TrialOrders, 1> orders = {{{0, 0}}};
  static constexpr TrialSettings extreme = {200.0, 200.0};
  static constexpr bool exact_bound = false;
};

/// Its part of the random scenes.
struct LawShare {
  scene::FrictionLaw law;
  int percent;
};

/// Laws without keys of their own: none are drawn.
inline constexpr std::array<LawShare, 3> random_laws = {
    {{scene::laws::Dahl{}, 60}, {scene::laws::Coulomb{}, 30}, {scene::laws::None{}, 10}}};
static_assert(random_laws[0].percent + random_laws[1].percent + random_laws[2].percent == 100);

/// Whether a scene with this law is drawn.
template <class Law>
constexpr bool is_drawn() {
  for (const LawShare& share : random_laws) {
    if (scene::is<Law>(share.law)) {
      return true;
    }
  }
  return false;
}

}  // namespace sonoglide::stability
