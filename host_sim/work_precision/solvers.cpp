#include "host_sim/work_precision/solvers.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host_sim/peers/paper_rk4.hpp"
#include "host_sim/work_precision/fixed_step_contenders.hpp"
#include "host_sim/work_precision/gauss_contenders.hpp"
#include "host_sim/work_precision/strang_contenders.hpp"
#include "host_sim/work_precision/taylor_contenders.hpp"
#ifdef SONOGLIDE_WITH_ODEINT
#include "host_sim/peers/odeint/dopri5.hpp"
#endif
#ifdef SONOGLIDE_WITH_CVODE
#include "host_sim/peers/sundials/cvode.hpp"
#endif

namespace sonoglide::work_precision {
namespace {

/// 10^-first … 10^-last, two for each decade.
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

/// Four for each decade.
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

}  // namespace

const std::vector<Solver>& solvers() {
  constexpr Knob tolerance = Knob::tolerance;
  constexpr Knob steps = Knob::steps_per_period;
  static const std::vector<Solver> all = {
      {"event_taylor_8", Family::event_taylor, tolerance, tolerances(1, 14),
       event_taylor<double, 8>},
      {"event_taylor_12", Family::event_taylor, tolerance, tolerances(1, 15),
       event_taylor<double, 12>},
      {"event_taylor_16", Family::event_taylor, tolerance, tolerances(1, 15),
       event_taylor<double, 16>},
      {"event_taylor_20", Family::event_taylor, tolerance, tolerances(1, 15),
       event_taylor<double, 20>},
      {"event_gauss_8", Family::event_gauss, tolerance, tolerances(1, 12), event_gauss<double, 8>},
      {"event_gauss_12", Family::event_gauss, tolerance, tolerances(6, 14),
       event_gauss<double, 12>},
      {"strang", Family::fixed_step, tolerance, tolerances(1, 9), strang<double>},
      {"rk4", Family::fixed_step, steps, step_counts(1, 5), rk4<double>},
      {"rk4_event", Family::fixed_step, steps, step_counts(1, 4), rk4_event<double>},
      {"event_taylor_8_float32", Family::single, tolerance, tolerances(1, 7),
       event_taylor<float, 8>},
      {"event_taylor_12_float32", Family::single, tolerance, tolerances(1, 7),
       event_taylor<float, 12>},
      {"event_gauss_8_float32", Family::single, tolerance, tolerances(1, 7), event_gauss<float, 8>},
      {"strang_float32", Family::single, tolerance, tolerances(1, 5), strang<float>},
      {"rk4_float32", Family::single, steps, step_counts(1, 4), rk4<float>},
      {"rk4_event_float32", Family::single, steps, step_counts(1, 4), rk4_event<float>},
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
  return all;
}

std::string setting_text(Knob knob, double setting) {
  return knob == Knob::tolerance ? fmt::format("tolerance {:.2g}", setting)
                                 : fmt::format("{:.0f} steps per period", setting);
}

}  // namespace sonoglide::work_precision
