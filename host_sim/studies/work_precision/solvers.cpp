#include "host_sim/studies/work_precision/solvers.hpp"

#include <fmt/format.h>

#include <utility>

#include "host_sim/configure/solver_methods.hpp"
#include "host_sim/studies/work_precision/contenders.hpp"
#include "host_sim/studies/work_precision/peers/paper_rk4.hpp"
#include "host_sim/studies/work_precision/settings.hpp"
#ifdef SONOGLIDE_WITH_ODEINT
#include "host_sim/studies/work_precision/peers/odeint/dopri5.hpp"
#endif
#ifdef SONOGLIDE_WITH_CVODE
#include "host_sim/studies/work_precision/peers/sundials/cvode.hpp"
#endif

namespace sonoglide::work_precision {
namespace {

template <class Scalar>
void add_own(std::vector<Solver>& all) {
  configure::for_each_solver([&](auto described, scene::SolverMethod /*method*/) {
    for (Solver& solver : contenders<decltype(described), Scalar>()) {
      all.push_back(std::move(solver));
    }
  });
}

std::vector<Solver> peers_of_them() {
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

const std::vector<Solver>& solvers() {
  static const std::vector<Solver> all = [] {
    std::vector<Solver> list;
    add_own<double>(list);
    add_own<float>(list);
    for (Solver& peer : peers_of_them()) {
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
