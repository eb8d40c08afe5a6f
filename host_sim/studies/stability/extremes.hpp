/// Every solver over random extreme scenes, and what became of each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "host_sim/studies/stability/parallel.hpp"
#include "host_sim/studies/stability/trial.hpp"

namespace sonoglide::stability {

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

}  // namespace sonoglide::stability
