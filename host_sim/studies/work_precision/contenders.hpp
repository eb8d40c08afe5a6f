/// The product's solvers as contenders.
#pragma once

#include <vector>

#include "host_sim/studies/work_precision/solvers.hpp"

namespace sonoglide::work_precision {

/// One for each order in which a solver takes part, in double or in float. Defined in
/// make_contenders.hpp; each has a translation unit of its own, which CMake makes of
/// contenders.cpp.in: they take long to compile.
template <class Described, class Scalar>
std::vector<Solver> contenders();

}  // namespace sonoglide::work_precision
