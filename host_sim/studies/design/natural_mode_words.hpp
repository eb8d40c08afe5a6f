/// Words that several pieces of advice on the natural mode share.
#pragma once

#include <string>

#include "host_sim/studies/design/natural_mode.hpp"
#include "host_sim/studies/design/report.hpp"

namespace sonoglide::design {

/// What keeps the mode quiet: a notch, the ramp, both or nothing.
std::string means(const QuietDrive& drive);
/// As a line of a scene.
std::string word(const QuietDrive& drive);
/// How soon a plant has to settle.
std::string promptly();
std::string tally_text(const Tally& tally);

/// Which of the advice about drive, loop and carrier is enough by itself.
Advice choice_advice(const NaturalModeStudy& mode);

}  // namespace sonoglide::design
