#include "host_sim/scene/solver_methods.hpp"

#include "host_sim/scene/solver_facts.hpp"

namespace sonoglide::scene {

std::string_view name_of(SolverMethod method) {
  return name_of(solver_methods, method);
}

bool is_adaptive(SolverMethod method) {
  return with_solver(method, [](auto solver) { return decltype(solver)::adaptive; });
}

bool takes_longest_step(SolverMethod method) {
  return with_solver(method, [](auto solver) {
    if constexpr (decltype(solver)::adaptive) {
      return decltype(solver)::takes_step;
    }
    return false;
  });
}

bool takes_order(SolverMethod method) {
  return with_solver(method, [](auto solver) { return decltype(solver)::takes_order; });
}

std::vector<int> built_orders(SolverMethod method) {
  return with_solver(method, [](auto solver) {
    constexpr auto orders = decltype(solver)::orders;
    return std::vector<int>(orders.begin(), orders.end());
  });
}

bool follows_straight_drives(SolverMethod method) {
  return with_solver(method,
                     [](auto solver) { return !decltype(solver)::straight_orders.empty(); });
}

std::optional<int> straight_order(SolverMethod method) {
  return with_solver(method, [](auto solver) {
    std::optional<int> order;
    if constexpr (decltype(solver)::takes_order && !decltype(solver)::straight_orders.empty()) {
      order = decltype(solver)::straight_orders[0];
    }
    return order;
  });
}

bool moves_load(SolverMethod method) {
  return with_solver(method, [](auto solver) { return solves_load<decltype(solver)>; });
}

bool counts_events(SolverMethod method) {
  return with_solver(method, [](auto solver) { return decltype(solver)::counts_events; });
}

}  // namespace sonoglide::scene
