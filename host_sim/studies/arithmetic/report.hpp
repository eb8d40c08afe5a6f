/// The files and the printed table that a comparison leaves behind.
#pragma once

#include <string>

#include "host_sim/output/output_folder.hpp"
#include "host_sim/studies/arithmetic/comparison.hpp"

namespace sonoglide::arithmetic {

/// One line for each image under a heading line; what is not defined is nan.
std::string images_csv(const ArithmeticComparison& comparison);

/// One line for each target and arithmetic.
std::string targets_csv(const ArithmeticComparison& comparison);

/// Left: difference from float64 against instructions per step, a point for each image. Right:
/// difference and ripple against the target.
/// @throws process::ProcessError
std::string draw(const ArithmeticComparison& comparison, const std::string& title);

/// arithmetic.csv, targets.csv and arithmetic.svg. @throws process::ProcessError
output::StudyReport report(const scene::Scene& scene, const ArithmeticComparison& comparison);

}  // namespace sonoglide::arithmetic
