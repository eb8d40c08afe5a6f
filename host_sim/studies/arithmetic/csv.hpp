/// arithmetic.csv and targets.csv.
#pragma once

#include <string>

#include "host_sim/studies/arithmetic/comparison.hpp"

namespace sonoglide::arithmetic {

/// One line for each image under a heading line; what is not defined is nan.
std::string images_csv(const Comparison& comparison);

/// One line for each target and arithmetic.
std::string targets_csv(const Comparison& comparison);

}  // namespace sonoglide::arithmetic
