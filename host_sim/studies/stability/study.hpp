/// Maps and extreme cases, computed and written as one report.
#pragma once

#include <cstdint>
#include <filesystem>

#include "host_sim/output/page.hpp"
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
/// and report.html.
/// @throws output::OutputError, process::ProcessError; nothing was written then
void write_study(const std::filesystem::path& out, const StabilityStudy& study);

}  // namespace sonoglide::stability
