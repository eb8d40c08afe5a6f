/// Friction equations followed in time by Boost.odeint, from piece to piece.
#pragma once

#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <stdexcept>

#include "tests/host_sim/loop/equations/friction_equations.hpp"

namespace sonoglide::equations {

/// By the Runge-Kutta formula of order 8, near the rounding of each number. In steps at whose ends
/// it is seen whether a piece has ended; where, is halved down to a rounding.
///
/// @param forcing  of time: what acts; smooth from `begin_s` to `end_s`, no sign of Vt changes
template <class Forcing>
void follow(FrictionEquations& equations, const Forcing& forcing, double begin_s, double end_s,
            double step_s, State& state) {
  namespace odeint = boost::numeric::odeint;
  const auto formula =
      odeint::make_controlled(1e-25, 1e-12, odeint::runge_kutta_fehlberg78<State>());
  const double sign = forcing(0.5 * (begin_s + end_s)).sliding_m_per_s < 0.0 ? -1.0 : 1.0;
  const auto system = [&](const State& at, State& rate, double time_s) {
    rate = equations.rate(at, forcing(time_s), sign);
  };
  const auto moved = [&](double time_s, double length_s) {
    State after = state;
    odeint::integrate_adaptive(formula, system, after, time_s, time_s + length_s, length_s);
    return after;
  };
  const auto has_left = [&](const State& after, double time_s) {
    return equations.margin(after, forcing(time_s)) < 0.0;
  };
  double time_s = begin_s;
  equations.enter_piece(state, forcing(time_s));
  for (int pieces = 0; time_s < end_s;) {
    const double length_s = std::min(step_s, end_s - time_s);
    const State after = moved(time_s, length_s);
    if (!has_left(after, time_s + length_s)) {
      state = after;
      time_s = length_s < step_s ? end_s : time_s + length_s;
      continue;
    }
    double inside_s = 0.0;
    double outside_s = length_s;
    for (int i = 0; i < 60; ++i) {
      const double middle_s = 0.5 * (inside_s + outside_s);
      const bool left = has_left(moved(time_s, middle_s), time_s + middle_s);
      (left ? outside_s : inside_s) = middle_s;
    }
    state = moved(time_s, outside_s);
    time_s += outside_s;
    equations.enter_piece(state, forcing(time_s));
    if (++pieces > 100000) {
      throw std::runtime_error("the contact leaves one piece after the other");
    }
  }
}

}  // namespace sonoglide::equations
