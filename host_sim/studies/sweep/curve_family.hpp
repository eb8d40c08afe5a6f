/// Two swept keys, one of them by name, as a curve for each name.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host_sim/studies/sweep/plan.hpp"
#include "host_sim/studies/sweep/row.hpp"

namespace sonoglide::sweep {

/// A gnuplot script: the sweep's subject() against the one key, a curve for each value of the
/// other; failed points are left out. Other axes have one value.
/// @param along   with more than one value, not categorical
/// @param family  categorical
std::string curve_family(const Plan& plan, const std::vector<Row>& rows, std::size_t along,
                         std::size_t family);

}  // namespace sonoglide::sweep
