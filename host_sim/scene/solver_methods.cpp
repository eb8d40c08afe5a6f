#include "host_sim/scene/solver_methods.hpp"

namespace sonoglide::scene {

std::string_view name_of(SolverMethod method) {
  return name_of(solver_methods, method);
}

bool is_adaptive(SolverMethod method) {
  return with_solver(method, [](auto solver) { return decltype(solver)::adaptive; });
}

bool counts_events(SolverMethod method) {
  return with_solver(method, [](auto solver) { return decltype(solver)::counts_events; });
}

bool solves(SolverMethod method, const FrictionLaw& law) {
  return with_solver(method, [&](auto solver) {
    return std::visit(
        [](const auto& any) {
          using Law = typename std::decay_t<decltype(any)>::template Core<double>;
          return takes_law<decltype(solver), Law>;
        },
        law);
  });
}

}  // namespace sonoglide::scene
