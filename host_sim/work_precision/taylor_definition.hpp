/// Where taylor_contenders.hpp comes from; the orders are built in more than one file because each
/// takes long to compile.
#pragma once

#include "firmware/plant/event_taylor.hpp"
#include "host_sim/work_precision/composed.hpp"
#include "host_sim/work_precision/taylor_contenders.hpp"

namespace sonoglide::work_precision {

namespace detail {

template <std::size_t Order>
struct OfOrder {
  template <class Model>
  using Solver = plant::EventTaylor<Model, Order>;
};

}  // namespace detail

template <class Scalar, std::size_t Order>
std::unique_ptr<peers::Contender> event_taylor(const peers::Problem& problem, double tolerance) {
  return compose<detail::OfOrder<Order>::template Solver, Scalar>(problem, tolerance);
}

}  // namespace sonoglide::work_precision
