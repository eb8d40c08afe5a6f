/// The solver for weakly coupled contacts as a contender.
#pragma once

#include <cstddef>
#include <memory>

#include "host_sim/peers/contender.hpp"
#include "host_sim/peers/problem.hpp"

namespace sonoglide::work_precision {

/// Built with 8 and 12 nodes in double, with 8 in float.
template <class Scalar, std::size_t Nodes>
std::unique_ptr<peers::Contender> event_gauss(const peers::Problem& problem, double tolerance);

}  // namespace sonoglide::work_precision
