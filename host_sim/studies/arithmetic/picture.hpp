/// arithmetic.svg.
#pragma once

#include <string>

#include "host_sim/studies/arithmetic/comparison.hpp"

namespace sonoglide::arithmetic {

/// Left: difference from float64 against instructions per step, a point for each image. Right:
/// difference and ripple against the target.
/// @throws process::ProcessError
std::string draw(const Comparison& comparison, const std::string& title);

}  // namespace sonoglide::arithmetic
