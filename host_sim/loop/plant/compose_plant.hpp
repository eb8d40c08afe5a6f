/// The plants of one friction law, each composed of what a scene names: chosen once, before the
/// loop.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/ramped_cosine.hpp"
#include "host_sim/configure/plant_model.hpp"
#include "host_sim/loop/plant/composed_plant.hpp"
#include "host_sim/loop/plant/plant_description.hpp"
#include "host_sim/loop/plant/plant_port.hpp"
#include "host_sim/loop/plant/sliding_profile.hpp"
#include "host_sim/scene/cores/solver_cores.hpp"
#include "host_sim/scene/solver_methods.hpp"

namespace sonoglide::loop {

// The solvers that a scene chooses among, as makers of plants.

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
  const auto solver = configured_solver<Described, Solver>(description, model);
  if constexpr (Solver::Model::Sliding::moves) {
    return std::make_unique<ComposedPlant<Solver>>(scales, model, solver,
                                                   configure::initial_loaded_state(scene, scales));
  } else {
    return std::make_unique<ComposedPlant<Solver>>(scales, model, solver,
                                                   configure::initial_state(scene, scales));
  }
}

/// Whether a solver has the compositions of lean_plant; the others always take the general ones.
inline bool composed_lean(scene::SolverMethod method) {
  return scene::with_solver(method,
                            [](auto described) { return decltype(described)::composed_lean; });
}

namespace detail {

/// The orders in which a solver is built for a model.
template <class Described, class Model>
constexpr const auto& orders() {
  if constexpr (std::is_same_v<typename Model::Drive, plant::StraightDrive>) {
    return Described::straight_orders;
  } else {
    return Described::orders;
  }
}

/// The solver of an order for a model.
template <class Described, class Model, int Order>
auto solver_for() {
  if constexpr (Model::Sliding::moves) {
    return typename Described::template LoadedCore<Model, Order>();
  } else {
    return typename Described::template Core<Model, Order>();
  }
}

template <class Described, class Model, std::size_t... Index>
constexpr std::array<PlantMaker<Model>, sizeof...(Index)> makers(
    std::index_sequence<Index...> /*all*/) {
  return {make_composed_plant<
      Described, decltype(solver_for<Described, Model, orders<Described, Model>()[Index]>())>...};
}

template <class Model>
inline constexpr bool is_lean = std::is_same_v<typename Model::Sliding, plant::ConstantSliding>;

/// Null where the law is not solved, nor the order or the composition built.
template <class Described, class Model>
PlantMaker<Model> maker(int order) {
  if constexpr (scene::takes_law<Described, typename Model::FrictionLaw> &&
                (Described::composed_lean || !is_lean<Model>)&&(scene::solves_load<Described> ||
                                                                !Model::Sliding::moves)) {
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

// What of a scene is composed.

template <template <class> class Damping, class Drive, class Sliding, class Law>
std::unique_ptr<PlantPort> with_solver(const PlantDescription& description, const Law& law) {
  const auto model = configure::plant_model<double, Damping, Drive, Sliding>(
      law, description.scene.friction, description.scales, description.numbers);
  return find_solver<std::decay_t<decltype(model)>>(description.scene.solver)(description, model);
}

/// One composition serves every rare scene: it always uses the damped plant, whose damping is 0 if
/// the scene has none, a sliding velocity that may change and an amplitude that may be ramped.
template <class Drive, class Law>
std::unique_ptr<PlantPort> general_plant(const PlantDescription& description, const Law& law) {
  return with_solver<plant::Damped, Drive, plant::LinearSliding>(description, law);
}

/// A cosine and one sliding velocity, as in most scenes: the plant has no part that the scene does
/// not name. A scene without a drive has a cosine of amplitude 0.
template <class Law>
std::unique_ptr<PlantPort> lean_plant(const PlantDescription& description, const Law& law) {
  if (!(description.numbers.damping > 0.0)) {
    return with_solver<plant::Undamped, plant::CosineDrive, plant::ConstantSliding>(description,
                                                                                    law);
  }
  return with_solver<plant::Damped, plant::CosineDrive, plant::ConstantSliding>(description, law);
}

/// The laws whose plants take a tenth more time or so with parts that a scene does not name. With the
/// others it is less, and one composition for all scenes is enough.
template <class Law>
inline constexpr bool is_quick_law =
    std::is_same_v<Law, scene::laws::Dahl> || std::is_same_v<Law, scene::laws::Coulomb> ||
    std::is_same_v<Law, scene::laws::Iwan>;

template <class Law>
std::unique_ptr<PlantPort> make_law_plant(const PlantDescription& description, const Law& law) {
  const scene::Scene& scene = description.scene;
  if (scene.drive && scene.drive->is_straight()) {
    return general_plant<plant::StraightDrive>(description, law);
  }
  if constexpr (is_quick_law<Law>) {
    const bool is_ramped = scene.drive && scene.drive->is_ramped();
    if (!is_ramped && SlidingProfile(scene.sliding).is_constant() &&
        composed_lean(scene.solver.method)) {
      return lean_plant(description, law);
    }
  }
  return general_plant<plant::RampedCosineDrive>(description, law);
}

/// A plant with a load always has the damped composition.
template <class Drive, class Law>
std::unique_ptr<PlantPort> loaded_plant(const PlantDescription& description, const Law& law) {
  const scene::Scene& scene = description.scene;
  const auto model =
      configure::loaded_plant_model<Drive>(law, scene, description.scales, description.numbers);
  return find_solver<std::decay_t<decltype(model)>>(scene.solver)(description, model);
}

template <class Law>
std::unique_ptr<PlantPort> make_loaded_plant(const PlantDescription& description, const Law& law) {
  if constexpr (Law::template Core<double>::vibration != friction::Vibration::along) {
    throw std::logic_error("no load slides with this friction law");
  } else {
    const scene::Scene& scene = description.scene;
    return scene.drive && scene.drive->is_straight()
               ? loaded_plant<plant::StraightDrive>(description, law)
               : loaded_plant<plant::RampedCosineDrive>(description, law);
  }
}

}  // namespace sonoglide::loop
