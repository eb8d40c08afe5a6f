#include "host_sim/configure/solver_methods.hpp"

#include "host_sim/configure/solver_cores.hpp"
#include "host_sim/configure/solver_facts.hpp"
#include "host_sim/scene/friction_laws.hpp"
#include "host_sim/scene/law_cores.hpp"

namespace sonoglide::configure {

std::string_view name_of(scene::SolverMethod method) {
  return scene::name_of(solver_methods, method);
}

bool is_adaptive(scene::SolverMethod method) {
  return with_solver(method, [](auto solver) { return decltype(solver)::adaptive; });
}

bool counts_events(scene::SolverMethod method) {
  return with_solver(method, [](auto solver) { return decltype(solver)::counts_events; });
}

bool solves(scene::SolverMethod method, const scene::FrictionLaw& law) {
  return with_solver(method, [&](auto solver) {
    return std::visit(
        [](const auto& any) {
          using Law = typename std::decay_t<decltype(any)>::template Core<double>;
          return takes_law<decltype(solver), Law>;
        },
        law);
  });
}

}  // namespace sonoglide::configure
