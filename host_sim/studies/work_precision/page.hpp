/// report.html of a comparison.
#pragma once

#include <string>

#include "host_sim/output/page.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/studies/work_precision/comparison.hpp"

namespace sonoglide::work_precision {

/// @param svg  the picture of the same comparison
output::Page page(const scene::Scene& scene, const Comparison& comparison, const std::string& svg);

}  // namespace sonoglide::work_precision
