/// Maps and extreme cases, computed, and what they leave behind.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/output/page.hpp"
#include "host_sim/output/study_report.hpp"
#include "host_sim/studies/stability/stability_map.hpp"
#include "host_sim/studies/stability/trial.hpp"

namespace sonoglide::stability {

// Every solver over random extreme scenes, and what became of each.

inline constexpr std::uint32_t extreme_step_limit = 1000;  ///< per period

/// Largest balance residual that is good.
inline constexpr double allowed_residual_float64 = 1e-6;
inline constexpr double allowed_residual_float32 = 1e-2;

inline constexpr std::array<double, 5> residual_quantiles = {0.5, 0.9, 0.99, 0.999, 1.0};

struct WorstCase {
  std::uint64_t scene = 0;
  Verdict verdict = Verdict::good;
  TrialResult result;
};

/// One solver in one precision.
struct ExtremeRow {
  std::string_view solver;
  std::string_view precision;
  double setting = 0.0;
  std::array<std::uint64_t, verdict_count> count{};
  std::array<double, residual_quantiles.size()> residual{};  ///< of the runs handed over as good
  std::vector<WorstCase> worst;  ///< silent faults first, then by residual; at most five
};

struct Extremes {
  std::uint64_t scenes = 0;
  std::vector<ExtremeRow> rows;
};

/// Scenes 0 to count - 1; the result does not depend on the number of threads.
Extremes extremes(std::uint64_t count, const Progress& progress);

struct StabilityStudy {
  StabilityMaps maps;
  Extremes extremes;
};

StabilityStudy study(const MapGrid& grid, std::uint64_t scenes, const Progress& progress);

/// stability_map.csv, stability_map.svg, both for float32 too, extremes.csv, extremes_worst.csv
/// and report.html. @throws process::ProcessError
output::StudyReport report(const StabilityStudy& study);

// What the study shows: tables, pictures, its page and its lines.

/// The maps of one precision; the setting is a tolerance or a number of steps per period.
std::string map_csv(const StabilityMaps& maps, std::string_view precision);

/// One row for each solver and precision.
std::string extremes_csv(const Extremes& extremes);

/// The worst scenes of each solver and precision, with every number that makes them.
std::string worst_csv(const Extremes& extremes);

/// One line for each solver and precision: what was good, declined, and wrong without a word.
std::string study_text(const Extremes& extremes);

/// A panel for each solver, colours by verdict, and in the panels of rk4 and rk4_event the
/// theoretical limit of the method.
output::Sheet map_sheet(const StabilityMaps& maps, std::string_view precision);

output::Page study_page(const StabilityStudy& study);

}  // namespace sonoglide::stability
