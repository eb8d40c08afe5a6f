#include "host_sim/scene/solver_laws.hpp"

#include <type_traits>

#include "firmware/friction/none.hpp"
#include "firmware/plant/adaptive_strang.hpp"
#include "firmware/plant/damping.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/event_gauss.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/rk4.hpp"
#include "firmware/plant/rk4_event.hpp"

namespace sonoglide::scene {
namespace {

/// A solver answers for every law, but is no type for a law that it does not solve.
using AnyModel = plant::Model<friction::None<double>, plant::Undamped<double>, plant::NoDrive>;

template <class Solver>
bool solver_solves(const FrictionLaw& law) {
  return std::visit(
      [](const auto& any) {
        return Solver::template solves<typename std::decay_t<decltype(any)>::template Core<double>>;
      },
      law);
}

}  // namespace

bool solves(SolverMethod method, const FrictionLaw& law) {
  switch (method) {
    case SolverMethod::event_gauss:
      return solver_solves<plant::EventGauss<AnyModel, 8>>(law);
    case SolverMethod::strang:
      return solver_solves<plant::AdaptiveStrang<AnyModel>>(law);
    case SolverMethod::rk4:
      return solver_solves<plant::Rk4<AnyModel>>(law);
    case SolverMethod::rk4_event:
      return solver_solves<plant::Rk4Event<AnyModel>>(law);
    case SolverMethod::event_taylor:
      break;
  }
  return true;
}

}  // namespace sonoglide::scene
