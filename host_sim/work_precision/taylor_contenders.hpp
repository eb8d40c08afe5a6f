/// The event-located Taylor solver as a contender.
#pragma once

#include <cstddef>
#include <memory>

#include "host_sim/peers/contender.hpp"
#include "host_sim/peers/problem.hpp"

namespace sonoglide::work_precision {

/// Built for orders 8, 12, 16 and 20 in double; 8 and 12 in float, which resolves no more.
template <class Scalar, std::size_t Order>
std::unique_ptr<peers::Contender> event_taylor(const peers::Problem& problem, double tolerance);

}  // namespace sonoglide::work_precision
