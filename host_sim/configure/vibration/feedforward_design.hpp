/// The numbers of a drive that is fed forward.
#pragma once

#include <optional>

#include "host_sim/configure/vibration/notch_design.hpp"

namespace sonoglide::configure {

struct FeedforwardDesign {
  std::optional<NotchDesign> notch;
  double shaping_range = 0.0;  ///< by which the natural frequency may be off; 0: known exactly
  bool free_mode = false;      ///< the plant has a natural mode that no notch takes care of
  /// With which feedback cannot build up what the notch leaves; 0: the mode has as much.
  double missing_damping_N_s_per_m = 0.0;

  double changing_periods() const { return notch ? notch->span() : 0.0; }
  static constexpr double building_up_periods() { return 0.0; }
  static constexpr bool tells_mismatch() { return true; }
};

}  // namespace sonoglide::configure
