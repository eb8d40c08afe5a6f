/// One swept key as a curve.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host_sim/studies/sweep/plan.hpp"
#include "host_sim/studies/sweep/row.hpp"

namespace sonoglide::sweep {

/// A gnuplot script: the friction ratio over window and whole run against the key; in closed loop
/// the steady error with the ripple on either side. Failed points are grey lines from bottom to
/// top. Other axes have one value.
/// @param axis  with more than one value
std::string curve(const Plan& plan, const std::vector<PointResult>& rows, std::size_t axis);

/// A gnuplot script: the sweep's subject() against the one key, a curve for each value of the
/// other; failed points are left out. Other axes have one value.
/// @param along   with more than one value, not categorical
/// @param family  categorical
std::string curve_family(const Plan& plan, const std::vector<PointResult>& rows, std::size_t along,
                         std::size_t family);

}  // namespace sonoglide::sweep
