/// Two swept keys as a map of colours.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host_sim/studies/sweep/plan.hpp"
#include "host_sim/studies/sweep/row.hpp"

namespace sonoglide::sweep {

/// Along an axis a heat map shows at most this many values, evenly picked.
inline constexpr std::size_t most_cells_along = 200;

/// A gnuplot script: one cell for each point in the colour of the sweep's subject(), grey where
/// that is not defined. Other axes stay at their first value.
/// @param upward, rightward  axes with more than one value
/// @param rows  the subject is defined in one at least
std::string heat_map(const Plan& plan, const std::vector<Row>& rows, std::size_t upward,
                     std::size_t rightward);

}  // namespace sonoglide::sweep
