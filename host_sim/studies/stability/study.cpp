#include "host_sim/studies/stability/study.hpp"

#include <utility>

#include "host_sim/studies/stability/report.hpp"

namespace sonoglide::stability {
namespace {

/// The maps' part of the run time.
constexpr double maps_share = 0.3;

}  // namespace

StabilityStudy study(const MapGrid& grid, std::uint64_t scenes, const Progress& progress) {
  StabilityMaps maps = stability_maps(grid, [&](double part) { progress(maps_share * part); });
  Extremes rows =
      extremes(scenes, [&](double part) { progress(maps_share + (1.0 - maps_share) * part); });
  return {std::move(maps), std::move(rows)};
}

output::StudyReport report(const StabilityStudy& study) {
  const MapPictures pictures = {map_picture(study.maps, "float64"),
                                map_picture(study.maps, "float32")};
  return {{{"stability_map.csv", map_csv(study.maps, "float64")},
           {"stability_map.svg", pictures.float64},
           {"stability_map_float32.csv", map_csv(study.maps, "float32")},
           {"stability_map_float32.svg", pictures.float32},
           {"extremes.csv", extremes_csv(study.extremes)},
           {"extremes_worst.csv", worst_csv(study.extremes)},
           {"report.html", output::to_html(study_page(study, pictures))}},
          study_text(study.extremes)};
}

}  // namespace sonoglide::stability
