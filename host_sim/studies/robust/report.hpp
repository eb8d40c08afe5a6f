/// What a robustness study shows: its tables, its figures and its page.
#pragma once

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "host_sim/output/page.hpp"
#include "host_sim/studies/robust/statistics.hpp"
#include "host_sim/studies/robust/study.hpp"
#include "host_sim/studies/robust/task.hpp"

namespace sonoglide::robust {

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
