/// All points of a sweep on all cores, journalled.
#pragma once

#include <cstddef>
#include <vector>

#include "host_sim/studies/sweep/journal.hpp"
#include "host_sim/studies/sweep/pace.hpp"
#include "host_sim/studies/sweep/row.hpp"
#include "host_sim/studies/sweep/solve.hpp"

namespace sonoglide::sweep {

/// The rows of the whole grid, in its order: those that the journal holds and, into it, the others.
/// The rows are the same to the bit for any number of threads and after any interruption.
/// @param points  of the grid
/// @param pace    told of the points computed
/// @throws report::OutputError  the journal cannot be written
std::vector<Row> compute(const Solve& solve, std::size_t points, Journal& journal, Pace& pace);

}  // namespace sonoglide::sweep
