/// A sweep as a picture.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/studies/sweep/plan.hpp"
#include "host_sim/studies/sweep/row.hpp"

namespace sonoglide::sweep {

/// The axes with more than one value.
std::vector<std::size_t> drawn_axes(const Grid& grid);

/// Whether the picture is a heat map: two axes drawn, both on a scale or both by name.
bool is_heat_map(const Grid& grid);

/// One axis drawn: a curve; two: a heat map, the first one upwards, or, where one of them is by
/// name, a curve for each name. SVG. Absent for any other number of axes, and where no point has a
/// value.
/// @throws process::ProcessError
std::optional<std::string> draw(const Plan& plan, const std::vector<Row>& rows);

}  // namespace sonoglide::sweep
