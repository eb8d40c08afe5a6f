#include "host_sim/scene/cores/solves.hpp"

#include <type_traits>
#include <variant>

#include "host_sim/scene/cores/solver_cores.hpp"
#include "host_sim/scene/law_cores.hpp"
#include "host_sim/scene/solver_methods.hpp"

namespace sonoglide::scene {

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
