/// What the study shows: tables, pictures, its page and its lines.
#pragma once

#include <string>
#include <string_view>

#include "host_sim/output/page.hpp"
#include "host_sim/studies/stability/extremes.hpp"
#include "host_sim/studies/stability/stability_map.hpp"
#include "host_sim/studies/stability/study.hpp"

namespace sonoglide::stability {

/// The maps of one precision; the setting is a tolerance or a number of steps per period.
std::string map_csv(const StabilityMaps& maps, std::string_view precision);

/// One row for each solver and precision.
std::string extremes_csv(const Extremes& extremes);

/// The worst scenes of each solver and precision, with every number that makes them.
std::string worst_csv(const Extremes& extremes);

/// One line for each solver and precision: what was good, declined, and wrong without a word.
std::string study_text(const Extremes& extremes);

/// One SVG document: a panel for each solver, colours by verdict, and in the panels of rk4 and
/// rk4_event the theoretical limit of the method.
/// @throws process::ProcessError if gnuplot fails
std::string map_picture(const StabilityMaps& maps, std::string_view precision);

/// SVG documents.
struct MapPictures {
  std::string float64;
  std::string float32;
};

output::Page study_page(const StabilityStudy& study, const MapPictures& pictures);

}  // namespace sonoglide::stability
