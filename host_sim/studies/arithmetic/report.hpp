/// The files and the printed table that a comparison leaves behind.
#pragma once

#include <string>

#include "host_sim/output/output_folder.hpp"
#include "host_sim/output/page.hpp"
#include "host_sim/studies/arithmetic/comparison.hpp"

namespace sonoglide::arithmetic {

/// One line for each image under a heading line; what is not defined is nan.
std::string images_csv(const ArithmeticComparison& comparison);

/// One line for each target and arithmetic.
std::string targets_csv(const ArithmeticComparison& comparison);

/// Difference from float64 against instructions per step, a point for each image; difference and
/// ripple against the target.
output::Sheet diagrams(const scene::Scene& scene, const ArithmeticComparison& comparison);

output::Page page(const scene::Scene& scene, const ArithmeticComparison& comparison);

/// arithmetic.csv, targets.csv, arithmetic.svg and report.html. @throws process::ProcessError
output::StudyReport report(const scene::Scene& scene, const ArithmeticComparison& comparison);

}  // namespace sonoglide::arithmetic
