/// The solvers that a scene chooses among.
#pragma once

#include <memory>
#include <stdexcept>
#include <type_traits>

#include "firmware/friction/none.hpp"
#include "firmware/plant/adaptive_strang.hpp"
#include "firmware/plant/damping.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/event_gauss.hpp"
#include "firmware/plant/event_taylor.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/rk4.hpp"
#include "firmware/plant/rk4_event.hpp"
#include "host_sim/loop/composed_plant.hpp"
#include "host_sim/loop/plant_description.hpp"
#include "host_sim/loop/plant_port.hpp"

namespace sonoglide::loop {

template <class Model>
using PlantMaker = std::unique_ptr<PlantPort> (*)(const PlantDescription&, const Model&);

/// As the scene sets it.
template <class Solver>
Solver configured_solver(const PlantDescription& description, const typename Solver::Model& model) {
  const scene::Solver& chosen = description.scene.solver;
  const double step = chosen.step_s * description.scales.angular_frequency_rad_per_s;
  Solver solver;
  if constexpr (std::is_same_v<Solver, plant::AdaptiveStrang<typename Solver::Model>>) {
    if (step > 0.0) {
      solver.configure(model, chosen.tolerance, plant::max_steps_per_advance, step);
      return solver;
    }
  }
  solver.configure(model, scene::is_adaptive(chosen.method) ? chosen.tolerance : step);
  return solver;
}

template <class Solver>
std::unique_ptr<PlantPort> make_composed_plant(const PlantDescription& description,
                                               const typename Solver::Model& model) {
  const scene::Scene& scene = description.scene;
  const scene::PlantScales& scales = description.scales;
  return std::make_unique<ComposedPlant<Solver>>(scales, model,
                                                 configured_solver<Solver>(description, model),
                                                 scene::initial_state(scene, scales));
}

/// Null where the solver is not made for the model's friction law.
template <template <class> class Solver, class Model>
constexpr PlantMaker<Model> maker_if_solved() {
  // The solver is no type for a law that it does not solve, but answers for every law elsewhere.
  using AnyModel = plant::Model<friction::None<double>, plant::Undamped<double>, plant::NoDrive>;
  if constexpr (Solver<AnyModel>::template solves<typename Model::FrictionLaw>) {
    return make_composed_plant<Solver<Model>>;
  } else {
    return nullptr;
  }
}

template <class Model>
struct ListedSolver {
  scene::SolverMethod method;
  int order;               ///< of event_gauss its nodes; 0 where the method has but one
  PlantMaker<Model> make;  ///< null where the law is not solved
};

template <class Model>
using EventGauss8 = plant::EventGauss<Model, 8>;
template <class Model>
using EventGauss12 = plant::EventGauss<Model, 12>;

template <class Model>
inline constexpr ListedSolver<Model> solver_list[] = {
    {scene::SolverMethod::event_taylor, 8, make_composed_plant<plant::EventTaylor<Model, 8>>},
    {scene::SolverMethod::event_taylor, 12, make_composed_plant<plant::EventTaylor<Model, 12>>},
    {scene::SolverMethod::event_taylor, 16, make_composed_plant<plant::EventTaylor<Model, 16>>},
    {scene::SolverMethod::event_gauss, 8, maker_if_solved<EventGauss8, Model>()},
    {scene::SolverMethod::event_gauss, 12, maker_if_solved<EventGauss12, Model>()},
    {scene::SolverMethod::strang, 0, maker_if_solved<plant::AdaptiveStrang, Model>()},
    {scene::SolverMethod::rk4, 0, maker_if_solved<plant::Rk4, Model>()},
    {scene::SolverMethod::rk4_event, 0, maker_if_solved<plant::Rk4Event, Model>()},
};

/// A drive of straight pieces: what is exact with it, and what the paper uses.
template <class Law, class Damping, class Straight>
inline constexpr ListedSolver<plant::Model<Law, Damping, plant::StraightDrive<Straight>>>
    solver_list<plant::Model<Law, Damping, plant::StraightDrive<Straight>>>[] = {
        {scene::SolverMethod::event_taylor, 16,
         make_composed_plant<
             plant::EventTaylor<plant::Model<Law, Damping, plant::StraightDrive<Straight>>, 16>>},
        {scene::SolverMethod::rk4, 0,
         maker_if_solved<plant::Rk4, plant::Model<Law, Damping, plant::StraightDrive<Straight>>>()},
};

/// The order that the scene asks for, or the one that takes the least time at its tolerance.
inline int order_of(const scene::Solver& solver) {
  if (solver.method == scene::SolverMethod::event_gauss) {
    return solver.tolerance >= 1e-8 ? 8 : 12;
  }
  if (solver.method != scene::SolverMethod::event_taylor) {
    return 0;
  }
  const int cheapest = solver.tolerance >= 1e-5 ? 8 : solver.tolerance >= 1e-8 ? 12 : 16;
  return solver.order.value_or(cheapest);
}

/// @throws std::logic_error  the solver is not in the list, which a scene that was read from a file
///         has been checked for
template <class Model>
PlantMaker<Model> find_solver(const scene::Solver& solver) {
  const int order = order_of(solver);
  for (const ListedSolver<Model>& listed : solver_list<Model>) {
    if (listed.method == solver.method && listed.order == order && listed.make != nullptr) {
      return listed.make;
    }
  }
  throw std::logic_error("no such solver for this friction law");
}

}  // namespace sonoglide::loop
