#include "host_sim/studies/stability/solver_list.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <type_traits>
#include <utility>

#include "firmware/numeric/turn.hpp"
#include "firmware/plant/state_check.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/configure/solver_cores.hpp"
#include "host_sim/configure/solver_methods.hpp"
#include "host_sim/studies/stability/run_trial.hpp"

namespace sonoglide::stability {
namespace {

template <class Described, int Order, class Scalar>
TrialResult trial(const scene::Scene& scene, const TrialPlan& plan) {
  const scene::PlantScales scales = configure::plant_scales(scene);
  const double setting = Described::adaptive ? plan.setting : numeric::two_pi / plan.setting;
  return with_model<Scalar>(scene, scales, [&](const auto& model) {
    using Model = std::decay_t<decltype(model)>;
    if constexpr (configure::takes_law<Described, typename Model::FrictionLaw>) {
      using Solver = typename Described::template Core<Model, Order>;
      return run_trial<Solver>(scene, scales, model, plan, setting);
    } else {
      TrialResult refused;
      refused.supported = false;
      return refused;
    }
  });
}

/// As far past 1 as Rk4 calls rounding, unless it is exact.
template <class Described, class Scalar>
constexpr double friction_bound() {
  return Described::exact_bound ? 1.0 : static_cast<double>(plant::largest_friction<Scalar>);
}

/// With the order where it is the same in both arithmetics.
std::string name_in(std::string_view name, configure::TrialOrders orders) {
  return orders.float64 > 0 && orders.float64 == orders.float32
             ? fmt::format("{}_{}", name, orders.float64)
             : std::string(name);
}

template <class Described, std::size_t Row>
TriedSolver solver() {
  constexpr configure::TrialOrders orders = Described::trial_orders[Row];
  constexpr configure::TrialSettings extreme = Described::trial_settings;
  return {name_in(Described::name, orders),
          Described::adaptive,
          {{{"float64", trial<Described, orders.float64, double>, extreme.float64,
             friction_bound<Described, double>()},
            {"float32", trial<Described, orders.float32, float>, extreme.float32,
             friction_bound<Described, float>()}}}};
}

template <class Described, std::size_t... Row>
void add(std::vector<TriedSolver>& list, std::index_sequence<Row...> /*all*/) {
  (list.push_back(solver<Described, Row>()), ...);
}

}  // namespace

const std::vector<TriedSolver>& solvers() {
  static const std::vector<TriedSolver> list = [] {
    std::vector<TriedSolver> all;
    configure::for_each_solver([&](auto described, scene::SolverMethod /*method*/) {
      using Described = decltype(described);
      add<Described>(all, std::make_index_sequence<Described::trial_orders.size()>{});
    });
    return all;
  }();
  return list;
}

}  // namespace sonoglide::stability
