/// The stability maps of one precision, drawn side by side.
#pragma once

#include <string>
#include <string_view>

#include "host_sim/studies/stability/stability_map.hpp"

namespace sonoglide::stability {

/// One SVG document: a panel for each solver, colours by verdict, and in the panels of rk4 and
/// rk4_event the theoretical limit of the method.
/// @throws process::ProcessError if gnuplot fails
std::string map_picture(const StabilityMaps& maps, std::string_view precision);

}  // namespace sonoglide::stability
