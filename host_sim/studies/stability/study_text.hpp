/// The extreme cases in a few printed lines.
#pragma once

#include <string>

#include "host_sim/studies/stability/extremes.hpp"

namespace sonoglide::stability {

/// One line for each solver and precision: what was good, declined, and wrong without a word.
std::string study_text(const Extremes& extremes);

}  // namespace sonoglide::stability
