/// What a solver offers: the list, and its check at compile time.
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>

#include "firmware/plant/account.hpp"
#include "firmware/plant/outcome.hpp"
#include "firmware/plant/state.hpp"

namespace sonoglide::plant {

/// Observes nothing. Every other observer is a callable too. The step that it is given offers
///   begin(), length()   time since the beginning of the interval, and duration of the step
///   at(offset)          State at begin() + offset, offset in [0, length()]
///   friction_integral(), motion_integrals(), …   integrals over the step, see account.hpp
/// and is valid during the call only. An observer sees the motion; it cannot change it.
struct NoObserver {
  template <class Step>
  void operator()(const Step& /*step*/) const {}
};

/// A solver is a template over the plant::Model that it advances. It offers:
///   Model, Scalar   the plant that it solves, and the number type in which it computes
///   solves<Law>     whether it takes a friction law; a model of another is a static_assert
///   configure(model, setting, step_limit)
///                   begins anew: `setting` is the tolerance of an adaptive solver (error of the
///                   friction ratio and of the motion, relative to its scales), or the longest step
///                   in tau of another; `step_limit` the most steps of one advance
///   advance(interval, state, account, observer) -> Outcome
///                   takes the state over one Interval, in which the sliding velocity keeps its
///                   sign; adds every step to the account (account.hpp) and shows it to the
///                   observer (see NoObserver). A failure is an Error with its time
///   cost()          steps and events since configure()
/// For every solver |phi| <= 1 to rounding, the energy identity holds to its tolerance, and an
/// advance that is cut in two gives the same motion to its tolerance. The typed test suite
/// solver_suite.hpp tests all of this for each solver.
namespace detail {

template <class Solver, class = void>
struct HasConfigure : std::false_type {};
template <class Solver>
struct HasConfigure<Solver, std::void_t<decltype(std::declval<Solver&>().configure(
                                std::declval<const typename Solver::Model&>(),
                                std::declval<typename Solver::Scalar>(), std::uint32_t{}))>>
    : std::true_type {};

template <class Solver>
using OutcomeOfAdvance = decltype(std::declval<Solver&>().advance(
    std::declval<const IntervalOf<typename Solver::Model>&>(),
    std::declval<typename Solver::Model::PlantState&>(),
    std::declval<MeanFriction<typename Solver::Scalar>&>(), std::declval<NoObserver&>()));

template <class Solver, class = void>
struct HasAdvance : std::false_type {};
template <class Solver>
struct HasAdvance<Solver, std::void_t<OutcomeOfAdvance<Solver>>>
    : std::is_same<OutcomeOfAdvance<Solver>, Outcome<typename Solver::Scalar>> {};

template <class Solver, class = void>
struct HasCost : std::false_type {};
template <class Solver>
struct HasCost<Solver, std::void_t<decltype(std::declval<const Solver&>().cost())>>
    : std::is_same<std::decay_t<decltype(std::declval<const Solver&>().cost())>, Cost> {};

}  // namespace detail

/// True if Solver is a solver; otherwise it fails to compile, with the reason.
template <class Solver>
constexpr bool check_solver() {
  static_assert(detail::HasConfigure<Solver>::value,
                "a solver has configure(model, setting, step_limit): see plant/solver.hpp");
  static_assert(detail::HasAdvance<Solver>::value,
                "a solver has advance(interval, state, account, observer), which returns an "
                "Outcome: see plant/solver.hpp");
  static_assert(detail::HasCost<Solver>::value, "a solver has cost(): see plant/solver.hpp");
  return true;
}

}  // namespace sonoglide::plant
