/// work_precision.csv.
#pragma once

#include <string>

#include "host_sim/studies/work_precision/comparison.hpp"

namespace sonoglide::work_precision {

/// One line for each row under a heading line; what was not measured is left empty.
std::string to_csv(const Comparison& comparison);

}  // namespace sonoglide::work_precision
