/// Scatter that a few large values do not change.
#pragma once

#include <vector>

namespace sonoglide::identify::impedance {

/// The upper one of the two in the middle. @param values  at least one
double median(std::vector<double> values);

/// Standard deviation of Gaussian readings by the median of the distances from each to the next.
/// @param steps  those distances, at least one
double deviation_of_steps(std::vector<double> steps);

}  // namespace sonoglide::identify::impedance
