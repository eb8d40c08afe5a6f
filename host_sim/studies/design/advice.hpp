/// What a design comes to, in words.
#pragma once

#include <string>
#include <vector>

#include "host_sim/studies/design/study.hpp"

namespace sonoglide::design {

struct Advice {
  std::string topic;
  std::string sentence;
};

/// Whether each ratio is within reach and how far, what the closed form is worth, power, accuracy,
/// and which way resonance lies; with a transducer, what the amplifier must give and what would help.
std::vector<Advice> advice(const DesignStudy& study);

/// What cannot be had, and the nearest that can; empty where everything is within reach.
std::vector<std::string> shortfalls(const DesignStudy& study);

}  // namespace sonoglide::design
