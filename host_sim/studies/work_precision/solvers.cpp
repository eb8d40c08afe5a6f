#include "host_sim/studies/work_precision/solvers.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "host_sim/scene/solver_methods.hpp"
#include "host_sim/studies/work_precision/peers/contender.hpp"

namespace sonoglide::work_precision {

std::string status_of(plant::Error error) {
  switch (error) {
    case plant::Error::friction_bound_broken:
      return "friction bound broken";
    case plant::Error::too_many_steps:
      return "too many steps in a period";
    case plant::Error::not_finite:
      return "state not finite";
    case plant::Error::step_too_long:
      return "step too long";
    case plant::Error::none:
      break;
  }
  return "ok";
}

std::vector<double> tolerances(int first, int last) {
  std::vector<double> all;
  for (int half_decades = 2 * first; half_decades <= 2 * last; ++half_decades) {
    // Two digits, so that the text of a setting is the setting.
    const int decade = (half_decades + 1) / 2;
    const double digits = half_decades % 2 == 0 ? 1.0 : 3.2;
    all.push_back(digits * std::pow(10.0, -decade));
  }
  return all;
}

std::vector<double> step_counts(int first_decade, int last_decade) {
  std::vector<double> all;
  for (int decade = first_decade; decade < last_decade; ++decade) {
    for (const double digits : {1.0, 1.8, 3.2, 5.6}) {
      all.push_back(std::round(digits * std::pow(10.0, decade)));
    }
  }
  all.push_back(std::pow(10.0, last_decade));
  return all;
}

namespace {

template <class Scalar>
void add_own(std::vector<ComparedSolver>& all) {
  scene::for_each_solver([&](auto described, scene::SolverMethod /*method*/) {
    for (ComparedSolver& solver : contenders<decltype(described), Scalar>()) {
      all.push_back(std::move(solver));
    }
  });
}

std::vector<ComparedSolver> peers_of_them() {
  constexpr Knob tolerance = Knob::tolerance;
  constexpr Knob steps = Knob::steps_per_period;
  return {
      {"rk4_table", Family::paper, steps, step_counts(1, 5), peers::rk4_table},
      {"rk4_naive", Family::paper, steps, step_counts(1, 5), peers::rk4_naive},
#ifdef SONOGLIDE_WITH_ODEINT
      {"odeint_dopri5", Family::outside_peer, tolerance, tolerances(2, 13), peers::odeint_dopri5},
#endif
#ifdef SONOGLIDE_WITH_CVODE
      {"cvode_adams", Family::outside_peer, tolerance, tolerances(2, 13), peers::cvode_adams},
      {"cvode_adams_fixed_point", Family::outside_peer, tolerance, tolerances(2, 13),
       peers::cvode_adams_fixed_point},
      {"cvode_bdf", Family::outside_peer, tolerance, tolerances(2, 13), peers::cvode_bdf},
#endif
  };
}

}  // namespace

const std::vector<ComparedSolver>& solvers() {
  static const std::vector<ComparedSolver> all = [] {
    std::vector<ComparedSolver> list;
    add_own<double>(list);
    add_own<float>(list);
    for (ComparedSolver& peer : peers_of_them()) {
      list.push_back(std::move(peer));
    }
    return list;
  }();
  return all;
}

std::string setting_text(Knob knob, double setting) {
  return knob == Knob::tolerance ? fmt::format("tolerance {:.2g}", setting)
                                 : fmt::format("{:.0f} steps per period", setting);
}

}  // namespace sonoglide::work_precision
