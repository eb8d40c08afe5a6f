/// The rows of a sweep as text.
#pragma once

#include <ostream>
#include <vector>

#include "host_sim/studies/sweep/plan.hpp"
#include "host_sim/studies/sweep/row.hpp"

namespace sonoglide::sweep {

/// One line for each point, in the order of the grid, under a heading: the varied keys, the figures
/// of Row, status last. In closed loop also settling_time_s, steady_error, ripple, limit and fault.
/// Numbers read back the same to the bit; what is not defined is `nan`. A status with a comma is
/// quoted (RFC 4180).
void write_csv(std::ostream& out, const Plan& plan, const std::vector<Row>& rows);

}  // namespace sonoglide::sweep
