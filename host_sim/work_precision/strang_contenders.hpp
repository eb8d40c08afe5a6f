/// The product's splitting method, as a contender.
#pragma once

#include <memory>

#include "host_sim/peers/contender.hpp"
#include "host_sim/peers/problem.hpp"

namespace sonoglide::work_precision {

/// Built in double and in float.
template <class Scalar>
std::unique_ptr<peers::Contender> strang(const peers::Problem& problem, double tolerance);

}  // namespace sonoglide::work_precision
