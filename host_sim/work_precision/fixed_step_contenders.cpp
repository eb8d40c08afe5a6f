#include "host_sim/work_precision/fixed_step_contenders.hpp"

#include "firmware/plant/rk4.hpp"
#include "firmware/plant/rk4_event.hpp"
#include "host_sim/work_precision/composed.hpp"

namespace sonoglide::work_precision {
namespace {

double step(double steps_per_period) {
  return peers::carrier_period / steps_per_period;
}

}  // namespace

using Made = std::unique_ptr<peers::Contender>;

template <class Scalar>
Made rk4(const peers::Problem& problem, double steps_per_period) {
  return compose<plant::Rk4, Scalar>(problem, step(steps_per_period));
}

template <class Scalar>
Made rk4_event(const peers::Problem& problem, double steps_per_period) {
  return compose<plant::Rk4Event, Scalar>(problem, step(steps_per_period));
}

template Made rk4<double>(const peers::Problem& problem, double steps_per_period);
template Made rk4<float>(const peers::Problem& problem, double steps_per_period);
template Made rk4_event<double>(const peers::Problem& problem, double steps_per_period);
template Made rk4_event<float>(const peers::Problem& problem, double steps_per_period);

}  // namespace sonoglide::work_precision
