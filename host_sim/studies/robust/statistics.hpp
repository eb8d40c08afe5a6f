/// What a sample of plants tells of all plants.
#pragma once

#include <cstddef>
#include <vector>

namespace sonoglide::robust {

/// Quantiles by nearest rank: of n values the one at place ceil(p n) in rising order. NaN counts as
/// the largest value: a step that never settles.
struct Quantiles {
  double median;
  double p95;
  double p99;
  double worst;
};

/// @param values  at least one
Quantiles quantiles(std::vector<double> values);

/// Upper bound of a probability at a confidence, from independent runs: that of Clopper and Pearson
/// (1934), exact, of one side. With it as the probability, so few failures or fewer have the
/// probability 1 - confidence: solves sum_{i <= failures} C(n, i) p^i (1 - p)^(n - i) = 1 -
/// confidence. 1 if every run has failed.
/// @param runs        > 0
/// @param confidence  in (0, 1)
double failure_probability_upper(std::size_t failures, std::size_t runs, double confidence);

/// Whether two values are equal but for rounding: by 1e-12.
/// @param lowest  not above the highest
bool is_one_value(double lowest, double highest);

/// Rank of each value in rising order, from 0; equal ones, but for rounding, share their mean rank, NaN
/// is largest.
struct Ranks {
  explicit Ranks(const std::vector<double>& values);
  std::vector<double> places;
};

/// Correlation of Spearman (1904), in [-1, 1]: of the ranks. NaN if one of them does not vary.
double rank_correlation(const Ranks& a, const Ranks& b);

/// Part of the variance of the ranks of y that x explains alone, whether it rises, falls or turns:
/// the first-order index of Sobol (1993) of the ranks, by the means of y in classes of x, with the
/// part that chance gives to such means taken off, and not below 0. NaN if y does not vary.
/// @param x, y  of equal size; fewer than 32 tell nothing: NaN
double main_effect(const Ranks& x, const Ranks& y);

}  // namespace sonoglide::robust
