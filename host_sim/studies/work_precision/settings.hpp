/// The settings that solvers are run at, from coarse to fine.
#pragma once

#include <vector>

namespace sonoglide::work_precision {

/// 10^-first … 10^-last, two for each decade.
std::vector<double> tolerances(int first, int last);

/// Steps for each carrier period, four for each decade.
std::vector<double> step_counts(int first_decade, int last_decade);

}  // namespace sonoglide::work_precision
