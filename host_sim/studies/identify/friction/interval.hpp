/// 95 % intervals of the parameters of a law.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "host_sim/studies/identify/friction/law_problem.hpp"

namespace sonoglide::identify::friction {

/// Of the logarithm; not a number where the data leave that side open, as far as the range goes.
struct LogInterval {
  double low;
  double high;
};

/// Profile likelihood: at a value x of one parameter the others are fitted again, and
///   t(x) = ± sqrt((S(x) - S_min)/s²),  s² = S_min/(n - p), at least that of the stated errors and
/// of the last digit of the values,
/// is taken for Student's t with n - p degrees of freedom. So no interval rests on the law being
/// linear, and a parameter that the data do not bound has an open end. What counts is the mean of
/// the distribution functions over the scatters, each by its probability, so that misfit widens the
/// interval as far as the residuals show it.
///
/// @param best           parameters, the best for white scatter
/// @param probabilities  of the scatters
/// @return one for each parameter; open on both sides where there are no more readings than
///         parameters, or fewer different ones
std::vector<LogInterval> intervals(const LawProblem& problem, const Eigen::VectorXd& best,
                                   const std::vector<Scatter>& scatters,
                                   const std::vector<double>& probabilities);

}  // namespace sonoglide::identify::friction
