/// The solvers that a scene chooses among: the one place that lists them.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "host_sim/scene/names.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/scene/solvers/event_gauss.hpp"
#include "host_sim/scene/solvers/event_taylor.hpp"
#include "host_sim/scene/solvers/rk4.hpp"
#include "host_sim/scene/solvers/rk4_event.hpp"
#include "host_sim/scene/solvers/strang.hpp"

namespace sonoglide::scene {

/// What a solver offers is listed at solvers::EventTaylor. Messages name them in this order.
using SolverMethods = std::tuple<solvers::EventTaylor, solvers::EventGauss, solvers::Strang,
                                 solvers::Rk4, solvers::Rk4Event>;

inline constexpr std::size_t solver_count = std::tuple_size_v<SolverMethods>;

template <std::size_t Index>
using SolverAt = std::tuple_element_t<Index, SolverMethods>;

namespace detail {

template <class Visitor, std::size_t... Index>
constexpr void for_each_solver(const Visitor& visitor, std::index_sequence<Index...> /*all*/) {
  (visitor(SolverAt<Index>{}, SolverMethod{Index}), ...);
}

}  // namespace detail

/// Calls visitor(solver, method) with each of them.
template <class Visitor>
constexpr void for_each_solver(const Visitor& visitor) {
  detail::for_each_solver(visitor, std::make_index_sequence<solver_count>{});
}

/// Calls visitor(solver) with the chosen one.
/// @return what that returns, a value that can be assigned
template <class Visitor>
constexpr auto with_solver(SolverMethod chosen, const Visitor& visitor) {
  decltype(visitor(SolverAt<0>{})) result{};
  for_each_solver([&](auto solver, SolverMethod method) {
    if (method == chosen) {
      result = visitor(solver);
    }
  });
  return result;
}

inline constexpr std::array<Named<SolverMethod>, solver_count> solver_methods = [] {
  std::array<Named<SolverMethod>, solver_count> named{};
  for_each_solver([&](auto solver, SolverMethod method) {
    named[method.index] = {decltype(solver)::name, method};
  });
  return named;
}();

/// solver_count where there is no such solver.
constexpr std::size_t solver_index(std::string_view name) {
  std::size_t index = 0;
  while (index < solver_count && solver_methods[index].name != name) {
    ++index;
  }
  return index;
}

namespace detail {

template <template <class, int> class Core>
struct Names;
template <class Described, class = void>
inline constexpr bool has_loaded_core = false;
template <class Described>
inline constexpr bool
    has_loaded_core<Described, std::void_t<Names<Described::template LoadedCore>*>> = true;

}  // namespace detail

/// Whether a solver takes a [load].
template <class Described>
inline constexpr bool solves_load = detail::has_loaded_core<Described>;

template <class Described>
inline constexpr SolverMethod method_of{solver_index(Described::name)};

}  // namespace sonoglide::scene
