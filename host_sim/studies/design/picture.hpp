/// A design as pictures.
#pragma once

#include <string>

#include "host_sim/studies/design/study.hpp"

namespace sonoglide::design {

/// Each one an SVG document. @throws process::ProcessError

/// Required force and power over the sliding speed, the drive's limit shaded.
std::string draw_requirements(const Study& study);

/// Bars of d ln rho/d ln p at the fastest of the task's speeds, a colour a ratio; some ratio has a
/// motion there.
std::string draw_sensitivities(const Study& study);

/// Over the tuning Ks/(m w²): the ratio under the scene's force, the force that keeps it, and what
/// 1 % of the spring then costs; some ratio has a motion.
std::string draw_detunings(const Study& study);

}  // namespace sonoglide::design
