/// Distributions that the intervals and the judgement of a fit rest on.
#pragma once

namespace sonoglide::identify {

/// Probability that a Student variable is at most t.
/// @param degrees_of_freedom  > 0, need not be whole
double student_t_probability(double degrees_of_freedom, double t);

/// The t that a Student variable is at most with that probability, in (0, 1).
/// @param degrees_of_freedom  > 0, need not be whole
double student_t_quantile(double degrees_of_freedom, double probability);

/// The t for which a Student variable is within ±t in 95 % of cases.
double student_t_95(double degrees_of_freedom);

/// Probability that a chi-squared variable is above a value, >= 0.
/// @param degrees_of_freedom  > 0
double chi_squared_above(double degrees_of_freedom, double value);

}  // namespace sonoglide::identify
