/// Integrals of the velocity times a weight, over the steps of a solver.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#include "firmware/numeric/gauss_legendre.hpp"

namespace sonoglide::plant {

namespace detail {

struct QuadratureRule {
  const double* node;
  const double* weight;
  std::size_t count;
};

template <int Count>
QuadratureRule quadrature_rule_of() {
  static constexpr auto rule = numeric::gauss_legendre<Count>();
  return {rule.node.data(), rule.weight.data(), rule.node.size()};
}
template <class Scalar>
QuadratureRule quadrature_rule_for(Scalar length) {
  if (length <= Scalar(0.125)) {
    return quadrature_rule_of<4>();
  }
  return length <= Scalar(1) ? quadrature_rule_of<8>() : quadrature_rule_of<16>();
}

template <class Step, class = void>
struct HasVelocityMoment : std::false_type {};
template <class Step>
struct HasVelocityMoment<Step, std::void_t<decltype(std::declval<Step>().velocity_moment())>>
    : std::true_type {};

}  // namespace detail

/// Calls add(t, w v) at each node of a Gauss-Legendre quadrature of the step: t is the time since
/// the step began, w the weight of the node, v the velocity, which is smooth in a step. The sum of
/// w v f(t) is the integral of v f over the step.
///
/// Error: a few roundings for steps up to 3 rad of a motion whose harmonics above the fourth are
/// small in a step; a solver's own error comes on top.
template <class Step, class Add>
void integrate_velocity(const Step& step, const Add& add) {
  const auto length = step.length();
  using Scalar = std::decay_t<decltype(length)>;
  const detail::QuadratureRule rule = detail::quadrature_rule_for(length);
  for (std::size_t i = 0; i < rule.count; ++i) {
    const Scalar offset = length * static_cast<Scalar>(rule.node[i]);
    add(offset, length * static_cast<Scalar>(rule.weight[i]) * step.at(offset).velocity);
  }
}

/// The integral of t v over the step, t since the step began: by integrate_velocity(), or what a step
/// offers that has more in it.
template <class Step>
auto velocity_moment(const Step& step) {
  if constexpr (detail::HasVelocityMoment<Step>::value) {
    return step.velocity_moment();
  } else {
    std::decay_t<decltype(step.length())> moment{};
    integrate_velocity(step,
                       [&moment](auto offset, auto weighted) { moment += offset * weighted; });
    return moment;
  }
}

}  // namespace sonoglide::plant
