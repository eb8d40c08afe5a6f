/// The product's solvers with steps of a fixed length, as contenders.
#pragma once

#include <memory>

#include "host_sim/peers/contender.hpp"
#include "host_sim/peers/problem.hpp"

namespace sonoglide::work_precision {

/// Built in double and in float.
template <class Scalar>
std::unique_ptr<peers::Contender> rk4(const peers::Problem& problem, double steps_per_period);
template <class Scalar>
std::unique_ptr<peers::Contender> rk4_event(const peers::Problem& problem, double steps_per_period);

}  // namespace sonoglide::work_precision
