/// With which settings the product's solvers are compared, and in which colours.
#pragma once

#include <array>

#include "host_sim/scene/solver_methods.hpp"
#include "host_sim/studies/work_precision/solvers.hpp"

namespace sonoglide::work_precision {

/// Of one order of a solver: tolerances from 10^-first_decade down to 10^-last_decade, or
/// 10^first_decade up to 10^last_decade steps for each carrier period.
struct Sweep {
  int order;  ///< 0 where the solver has but one
  int first_decade;
  int last_decade;
};

/// Every solver has its own:
///   family                          colours of its curves, shared with others like it
///   float64_sweeps, float32_sweeps  in each arithmetic
template <class Described>
struct Settings;

template <>
struct Settings<scene::solvers::EventTaylor> {
  static constexpr Family family = Family::blue;
  static constexpr std::array<Sweep, 4> float64_sweeps = {
      {{8, 1, 14}, {12, 1, 15}, {16, 1, 15}, {20, 1, 15}}};
  static constexpr std::array<Sweep, 2> float32_sweeps = {{{8, 1, 7}, {12, 1, 7}}};
};

template <>
struct Settings<scene::solvers::EventGauss> {
  static constexpr Family family = Family::orange;
  static constexpr std::array<Sweep, 2> float64_sweeps = {{{8, 1, 12}, {12, 6, 14}}};
  static constexpr std::array<Sweep, 1> float32_sweeps = {{{8, 1, 7}}};
};

template <>
struct Settings<scene::solvers::Strang> {
  static constexpr Family family = Family::green;
  static constexpr std::array<Sweep, 1> float64_sweeps = {{{0, 1, 9}}};
  static constexpr std::array<Sweep, 1> float32_sweeps = {{{0, 1, 5}}};
};

template <>
struct Settings<scene::solvers::Rk4> {
  static constexpr Family family = Family::green;
  static constexpr std::array<Sweep, 1> float64_sweeps = {{{0, 1, 5}}};
  static constexpr std::array<Sweep, 1> float32_sweeps = {{{0, 1, 4}}};
};

template <>
struct Settings<scene::solvers::Rk4Event> {
  static constexpr Family family = Family::green;
  static constexpr std::array<Sweep, 1> float64_sweeps = {{{0, 1, 4}}};
  static constexpr std::array<Sweep, 1> float32_sweeps = {{{0, 1, 4}}};
};

}  // namespace sonoglide::work_precision
