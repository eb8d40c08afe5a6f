/// Where contenders.hpp comes from.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <type_traits>
#include <utility>

#include "host_sim/configure/solver_methods.hpp"
#include "host_sim/studies/work_precision/composed.hpp"
#include "host_sim/studies/work_precision/contenders.hpp"
#include "host_sim/studies/work_precision/settings.hpp"

namespace sonoglide::work_precision {
namespace detail {

template <class Described, int Order>
struct OfOrder {
  template <class Model>
  using Solver = typename Described::template Core<Model, Order>;
};

template <class Described, int Order, class Scalar>
std::unique_ptr<peers::Contender> contender(const peers::Problem& problem, double setting) {
  return compose<OfOrder<Described, Order>::template Solver, Scalar>(
      problem, Described::adaptive ? setting : peers::carrier_period / setting);
}

constexpr Family family_of(configure::Palette palette) {
  switch (palette) {
    case configure::Palette::blue:
      return Family::blue;
    case configure::Palette::orange:
      return Family::orange;
    case configure::Palette::green:
      break;
  }
  return Family::green;
}

template <class Scalar>
inline constexpr bool is_single = std::is_same_v<Scalar, float>;

template <class Described, class Scalar>
constexpr const auto& sweeps() {
  if constexpr (is_single<Scalar>) {
    return Described::float32_sweeps;
  } else {
    return Described::float64_sweeps;
  }
}

template <class Described, class Scalar, std::size_t Index>
Solver solver() {
  constexpr configure::Sweep sweep = sweeps<Described, Scalar>()[Index];
  const std::string order = sweep.order > 0 ? fmt::format("_{}", sweep.order) : "";
  return {fmt::format("{}{}{}", Described::name, order, is_single<Scalar> ? "_float32" : ""),
          is_single<Scalar> ? Family::single : family_of(Described::palette),
          Described::adaptive ? Knob::tolerance : Knob::steps_per_period,
          Described::adaptive ? tolerances(sweep.first_decade, sweep.last_decade)
                              : step_counts(sweep.first_decade, sweep.last_decade),
          contender<Described, sweep.order, Scalar>};
}

template <class Described, class Scalar, std::size_t... Index>
std::vector<Solver> contenders(std::index_sequence<Index...> /*all*/) {
  return {solver<Described, Scalar, Index>()...};
}

}  // namespace detail

template <class Described, class Scalar>
std::vector<Solver> contenders() {
  return detail::contenders<Described, Scalar>(
      std::make_index_sequence<detail::sweeps<Described, Scalar>().size()>{});
}

}  // namespace sonoglide::work_precision
