/// What is to be said beside the figures of an identification.
#pragma once

#include <string>
#include <vector>

#include "host_sim/studies/identify/identification.hpp"
#include "host_sim/studies/identify/impedance/figures.hpp"
#include "host_sim/studies/identify/impedance/selection.hpp"

namespace sonoglide::identify::impedance {

/// Each a sentence or more: what was assumed of the file, and what is wrong with sweep or fit.
std::vector<std::string> warnings_of(const Selection& selected);

/// Each a sentence or more: what the data leave open, and what would tell.
/// @param estimates  the figures of the fit
std::vector<std::string> open_questions(const std::vector<Estimate>& estimates,
                                        const Selection& selected, const MechanicalFact& fact);

}  // namespace sonoglide::identify::impedance
