/// Maps and extreme cases, computed, and what they leave behind.
#pragma once

#include <cstdint>

#include "host_sim/output/study_report.hpp"
#include "host_sim/studies/stability/extremes.hpp"
#include "host_sim/studies/stability/parallel.hpp"
#include "host_sim/studies/stability/stability_map.hpp"

namespace sonoglide::stability {

struct StabilityStudy {
  StabilityMaps maps;
  Extremes extremes;
};

StabilityStudy study(const MapGrid& grid, std::uint64_t scenes, const Progress& progress);

/// stability_map.csv, stability_map.svg, both for float32 too, extremes.csv, extremes_worst.csv
/// and report.html. @throws process::ProcessError
output::StudyReport report(const StabilityStudy& study);

}  // namespace sonoglide::stability
