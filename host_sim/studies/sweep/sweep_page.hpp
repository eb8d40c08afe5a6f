/// The report page of a sweep.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host_sim/output/page.hpp"
#include "host_sim/studies/sweep/plan.hpp"
#include "host_sim/studies/sweep/row.hpp"

namespace sonoglide::sweep {

/// @param picture  an SVG document; absent where none can be drawn
output::Page sweep_page(const Plan& plan, const std::vector<Row>& rows,
                        const std::optional<std::string>& picture);

}  // namespace sonoglide::sweep
