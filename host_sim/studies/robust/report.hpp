/// What a robustness study shows: its tables, its figures and its page.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

#include "host_sim/output/page.hpp"
#include "host_sim/studies/robust/study.hpp"
#include "host_sim/studies/robust/task.hpp"

namespace sonoglide::robust {

// What a sample of plants tells of all plants.

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

/// Part of the variance that the means of so many classes have by chance alone: a main effect
/// below it is not told from 0.
/// @param count  of the plants, > 0
double effect_of_chance(std::size_t count);

/// A figure of every row.
struct Figure {
  const char* key;    ///< `settling_time_s`
  const char* label;  ///< with its unit
  double PlantRow::*value;
  const char* undefined;  ///< what tables show of a plant that has none
};

/// Those of robust.json.
const std::vector<Figure>& figures();

/// `1 plant`, `2 plants`.
std::string counted(std::size_t count, const char* noun);

/// Of every sample.
std::vector<double> values_of(const Study& study, const Figure& figure);
/// True values of one tolerance, of every sample.
std::vector<double> factors_of(const Task& task, std::size_t tolerance);

/// What one tolerance does to one figure.
struct Importance {
  double rank_correlation;
  double main_effect;
};
/// Of each tolerance, on each figure.
std::vector<std::vector<Importance>> importance(const Task& task, const Study& study);

/// One line for each sample, in their order: the true values, the figures, steps that never settle,
/// limits and faults by name, a blank between them, and whether the plant has failed. Numbers read
/// back the same to the bit; what is not defined is `nan`.
void write_samples(std::ostream& out, const Task& task, const Study& study);

/// The same for every run of the search, with its climb.
void write_search(std::ostream& out, const Task& task, const Study& study);

/// robust.json; what is not defined is null.
nlohmann::ordered_json to_json(const Task& task, const Study& study);

/// Runs the loop on the worst plant and on the scene's own again.
output::Page robust_page(const Task& task, const Study& study);

/// How often names come, the most frequent first.
struct NameCount {
  std::string name;
  std::size_t count;
};
std::vector<NameCount> count_names(const Study& study,
                                   std::vector<std::string> (*names)(const PlantRow&));

}  // namespace sonoglide::robust
