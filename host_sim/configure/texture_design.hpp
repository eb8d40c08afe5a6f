/// The numbers of a target that runs along the sliding distance.
#pragma once

#include <cstdint>
#include <vector>

#include "firmware/control/interface/drive_command.hpp"

namespace sonoglide::configure {

/// The integers are those of app::TexturePath and of the steps that advance it.
struct TextureDesign {
  std::vector<double> values;  ///< friction ratios, or forces [N]
  std::int64_t period = 0;
  std::uint32_t inverse = 0;
  std::uint32_t lead = 0;
  std::uint32_t weight = 0;

  /// Steepest change of the vibration at the fastest sliding, over what the drive can: above 1 it is not
  /// followed there. 0 where nothing limits it.
  double overload = 0.0;
  /// Strongest vibration of the texture there, over what a resonant drive holds; 0 of another drive.
  double vibration_demand = 0.0;
  double fastest_m_per_s = 0.0;                 ///< sliding
  control::Limit limit = control::Limit::none;  ///< that is named where it is not followed
};

}  // namespace sonoglide::configure
