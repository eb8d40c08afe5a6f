/// The solvers that a scene chooses among, as makers of plants.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "host_sim/loop/plant/composed_plant.hpp"
#include "host_sim/loop/plant/plant_description.hpp"
#include "host_sim/loop/plant/plant_port.hpp"
#include "host_sim/scene/cores/solver_cores.hpp"
#include "host_sim/scene/solver_methods.hpp"

namespace sonoglide::loop {

template <class Model>
using PlantMaker = std::unique_ptr<PlantPort> (*)(const PlantDescription&, const Model&);

/// As the scene sets it.
template <class Described, class Solver>
Solver configured_solver(const PlantDescription& description, const typename Solver::Model& model) {
  const scene::Solver& chosen = description.scene.solver;
  const double step = chosen.step_s * description.scales.angular_frequency_rad_per_s;
  Solver solver;
  if constexpr (!Described::adaptive) {
    solver.configure(model, step);
    return solver;
  } else {
    if constexpr (Described::takes_step) {
      if (step > 0.0) {
        solver.configure(model, chosen.tolerance, plant::max_steps_per_advance, step);
        return solver;
      }
    }
    solver.configure(model, chosen.tolerance);
    return solver;
  }
}

template <class Described, class Solver>
std::unique_ptr<PlantPort> make_composed_plant(const PlantDescription& description,
                                               const typename Solver::Model& model) {
  const scene::Scene& scene = description.scene;
  const scene::PlantScales& scales = description.scales;
  return std::make_unique<ComposedPlant<Solver>>(
      scales, model, configured_solver<Described, Solver>(description, model),
      configure::initial_state(scene, scales));
}

/// Whether a solver has the compositions of lean_plant; the others always take the general ones.
inline bool composed_lean(scene::SolverMethod method) {
  return scene::with_solver(method,
                            [](auto described) { return decltype(described)::composed_lean; });
}

template <class Drive>
inline constexpr bool is_straight = false;
template <class Straight>
inline constexpr bool is_straight<plant::StraightDrive<Straight>> = true;

namespace detail {

/// The orders in which a solver is built for a model.
template <class Described, class Model>
constexpr const auto& orders() {
  if constexpr (is_straight<typename Model::Drive>) {
    return Described::straight_orders;
  } else {
    return Described::orders;
  }
}

template <class Described, class Model, std::size_t... Index>
constexpr std::array<PlantMaker<Model>, sizeof...(Index)> makers(
    std::index_sequence<Index...> /*all*/) {
  return {make_composed_plant<
      Described, typename Described::template Core<Model, orders<Described, Model>()[Index]>>...};
}

template <class Model>
inline constexpr bool is_lean = std::is_same_v<typename Model::Sliding, plant::ConstantSliding>;

/// Null where the law is not solved, nor the order or the composition built.
template <class Described, class Model>
PlantMaker<Model> maker(int order) {
  if constexpr (scene::takes_law<Described, typename Model::FrictionLaw> &&
                (Described::composed_lean || !is_lean<Model>)) {
    constexpr auto& built = orders<Described, Model>();
    constexpr auto makers_of =
        makers<Described, Model>(std::make_index_sequence<orders<Described, Model>().size()>{});
    for (std::size_t i = 0; i < built.size(); ++i) {
      if (built[i] == order) {
        return makers_of[i];
      }
    }
  }
  return nullptr;
}

}  // namespace detail

/// In the order that the scene asks for, or the one that takes the least time at its tolerance.
/// @throws std::logic_error  there is no such solver for the model, for which a scene that was read
///         from a file has been checked
template <class Model>
PlantMaker<Model> find_solver(const scene::Solver& solver) {
  const PlantMaker<Model> make = scene::with_solver(solver.method, [&](auto described) {
    using Described = decltype(described);
    return detail::maker<Described, Model>(
        solver.order.value_or(Described::order_for(solver.tolerance)));
  });
  if (make == nullptr) {
    throw std::logic_error("no such solver for this friction law");
  }
  return make;
}

}  // namespace sonoglide::loop
