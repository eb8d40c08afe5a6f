/// The report page: what the maps and the table say, and what to do about it.
#pragma once

#include <string>

#include "host_sim/output/page.hpp"
#include "host_sim/studies/stability/study.hpp"

namespace sonoglide::stability {

/// SVG documents.
struct MapPictures {
  std::string float64;
  std::string float32;
};

output::Page study_page(const Study& study, const MapPictures& pictures);

}  // namespace sonoglide::stability
