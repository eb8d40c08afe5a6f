/// The friction force against the displacement travelled, over one cycle.
#pragma once

#include <vector>

#include "host_sim/loop/watch.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::report {

/// One monotone branch.
struct Branch {
  std::vector<double> displacement_m;  ///< u = ∫V dt since the cycle began
  std::vector<double> force_N;
};

struct HysteresisLoop {
  Branch forward;   ///< V > 0
  Branch backward;  ///< V < 0; empty where the sliding never reverses
};

/// The last full cycle of a recording, from one change to V > 0 to the next; where the sliding
/// never reverses, its last `samples_per_cycle` samples as one branch.
HysteresisLoop last_cycle(const loop::Recording& recording, scene::SignConvention convention,
                          std::size_t samples_per_cycle);

}  // namespace sonoglide::report
