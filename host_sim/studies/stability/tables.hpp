/// The results as comma-separated values.
#pragma once

#include <string>
#include <string_view>

#include "host_sim/studies/stability/extremes.hpp"
#include "host_sim/studies/stability/stability_map.hpp"

namespace sonoglide::stability {

/// The maps of one precision; the setting is a tolerance or a number of steps per period.
std::string map_csv(const StabilityMaps& maps, std::string_view precision);

/// One row for each solver and precision.
std::string extremes_csv(const Extremes& extremes);

/// The worst scenes of each solver and precision, with every number that makes them.
std::string worst_csv(const Extremes& extremes);

}  // namespace sonoglide::stability
