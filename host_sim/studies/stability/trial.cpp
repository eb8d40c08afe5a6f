#include "host_sim/studies/stability/trial.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>

#include "firmware/numeric/turn.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/outcome.hpp"
#include "firmware/plant/solver.hpp"
#include "firmware/plant/state.hpp"
#include "host_sim/configure/plant_model.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/scene/cores/solver_cores.hpp"
#include "host_sim/scene/law_cores.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/scene/solver_methods.hpp"
#include "host_sim/studies/stability/settings.hpp"

namespace sonoglide::stability {
namespace {

/// Calls visitor(model) with the plant::Model of an open-loop scene.
/// @throws std::logic_error  no random scene has this law, nor has a map
template <class Scalar, class Visitor>
TrialResult with_model(const scene::Scene& scene, const scene::PlantScales& scales,
                       const Visitor& visitor) {
  const configure::PlantNumbers numbers = configure::plant_numbers(scene, scales);
  return std::visit(
      [&](const auto& law) -> TrialResult {
        using Law = std::decay_t<decltype(law)>;
        if constexpr (is_drawn<Law>()) {
          return visitor(
              configure::plant_model<Scalar, plant::Damped, plant::CosineDrive,
                                     plant::LinearSliding>(law, scene.friction, scales, numbers));
        } else {
          throw std::logic_error("no random scene has this friction law");
        }
      },
      configure::acting_law(scene.friction));
}

/// Sliding velocity in units of the velocity scale: its start, and its rise in one period.
struct SlidingRamp {
  double begin;
  double rise;
};

SlidingRamp sliding_ramp(const scene::Scene& scene, const scene::PlantScales& scales, int periods) {
  const double begin = scene.sliding.profile.front().velocity_m_per_s;
  const double end = scene.sliding.profile.back().velocity_m_per_s;
  const double scale = scales.velocity_m_per_s();
  return {begin / scale, (end - begin) / scale / periods};
}

template <class Scalar>
plant::State<Scalar> initial_state(const scene::Scene& scene, const scene::PlantScales& scales) {
  const plant::State<double> initial = configure::initial_state(scene, scales);
  return {static_cast<Scalar>(initial.displacement), static_cast<Scalar>(initial.velocity),
          static_cast<Scalar>(initial.friction)};
}

template <class Scalar>
plant::Interval<Scalar> period(const scene::Scene& scene, const scene::PlantScales& scales,
                               const SlidingRamp& ramp, int number) {
  const double amplitude = scene.drive ? scene.drive->force_amplitude_N / scales.force_N : 0.0;
  return {Scalar(0), static_cast<Scalar>(numeric::two_pi), static_cast<Scalar>(amplitude),
          static_cast<Scalar>(ramp.begin + ramp.rise * number),
          static_cast<Scalar>(ramp.rise / numeric::two_pi)};
}

/// @param scene      open loop; the profile of its sliding has one point, or two that are the ends
///                   of the trial
/// @param precision  the solver's own setting: tolerance, or step in tau
template <class Solver>
TrialResult run_trial(const scene::Scene& scene, const scene::PlantScales& scales,
                      const typename Solver::Model& model, const TrialPlan& plan,
                      double precision) {
  using Scalar = typename Solver::Scalar;
  Solver solver;
  solver.configure(model, static_cast<Scalar>(precision), plan.step_limit);
  const SlidingRamp ramp = sliding_ramp(scene, scales, plan.periods);
  const plant::State<Scalar> initial = initial_state<Scalar>(scene, scales);
  plant::State<Scalar> state = initial;
  Witness witness;
  plant::NoObserver nobody;
  TrialResult result;
  for (int n = 0; n < plan.periods && result.error == plant::Error::none; ++n) {
    const auto interval = period<Scalar>(scene, scales, ramp, n);
    result.error = solver.advance(interval, state, witness, nobody).error;
  }
  const double tau = numeric::two_pi * plan.periods;
  result.finite = plant::is_finite(state) && std::isfinite(witness.friction_integral());
  result.largest_friction = witness.largest_friction();
  result.friction_ratio = std::copysign(1.0, ramp.begin) * witness.friction_integral() / tau;
  result.balance_residual = witness.balance_residual(model, initial, state);
  return result;
}

template <class Described, int Order, class Scalar>
TrialResult trial(const scene::Scene& scene, const TrialPlan& plan) {
  const scene::PlantScales scales = configure::plant_scales(scene);
  const double setting = Described::adaptive ? plan.setting : numeric::two_pi / plan.setting;
  return with_model<Scalar>(scene, scales, [&](const auto& model) {
    using Model = std::decay_t<decltype(model)>;
    if constexpr (scene::takes_law<Described, typename Model::FrictionLaw>) {
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
  return Settings<Described>::exact_bound ? 1.0
                                          : static_cast<double>(plant::largest_friction<Scalar>);
}

/// With the order where it is the same in both arithmetics.
std::string name_in(std::string_view name, TrialOrders orders) {
  return orders.float64 > 0 && orders.float64 == orders.float32
             ? fmt::format("{}_{}", name, orders.float64)
             : std::string(name);
}

template <class Described, std::size_t Row>
TriedSolver solver() {
  constexpr TrialOrders orders = Settings<Described>::orders[Row];
  constexpr TrialSettings extreme = Settings<Described>::extreme;
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
    scene::for_each_solver([&](auto described, scene::SolverMethod /*method*/) {
      using Described = decltype(described);
      add<Described>(all, std::make_index_sequence<Settings<Described>::orders.size()>{});
    });
    return all;
  }();
  return list;
}

Verdict judge(const TrialResult& result, double error, double allowed_error, double bound) {
  if (!result.supported) {
    return Verdict::unsupported;
  }
  switch (result.error) {
    case plant::Error::none:
      break;
    case plant::Error::not_finite:
      return Verdict::declined_not_finite;
    case plant::Error::friction_bound_broken:
      return Verdict::declined_friction_bound;
    case plant::Error::step_too_long:
      return Verdict::declined_step_too_long;
    case plant::Error::too_many_steps:
      return Verdict::declined_too_many_steps;
  }
  if (!result.finite) {
    return Verdict::silent_not_finite;
  }
  if (!(result.largest_friction <= bound)) {
    return Verdict::silent_friction_bound;
  }
  return error <= allowed_error ? Verdict::good : Verdict::wrong;
}

std::array<std::string_view, verdict_count> verdict_names(std::string_view good,
                                                          std::string_view wrong) {
  return {good,
          wrong,
          "silent_friction_bound",
          "silent_not_finite",
          "declined_friction_bound",
          "declined_step_too_long",
          "declined_not_finite",
          "declined_too_many_steps",
          "unsupported"};
}

}  // namespace sonoglide::stability
