/// What changes along a stretch: the spring, the friction coefficient, the normal force.
#pragma once

#include <algorithm>

#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// A number along a stretch in which its profile has no row.
struct Line {
  double middle = 0.0;
  double slope_per_s = 0.0;

  double at(double offset_from_middle_s) const {
    return middle + slope_per_s * offset_from_middle_s;
  }
};

/// @param constant  where there is no profile
inline Line line_over(const scene::TimedProfile& profile, double constant, double begin_s,
                      double duration_s) {
  if (profile.empty()) {
    return {constant, 0.0};
  }
  // Inside: at the ends there may be a jump.
  const double early = scene::value_at(profile, begin_s + 0.25 * duration_s);
  const double late = scene::value_at(profile, begin_s + 0.75 * duration_s);
  return {0.5 * (early + late), (late - early) / (0.5 * duration_s)};
}

struct Course {
  double duration_s = 0.0;
  Line stiffness_N_per_m;
  Line coefficient;
  Line normal_force_N;

  bool slopes() const {
    return stiffness_N_per_m.slope_per_s != 0.0 || coefficient.slope_per_s != 0.0 ||
           normal_force_N.slope_per_s != 0.0;
  }
  /// @param offset_s  since the stretch began
  double stiffness_at(double offset_s) const {
    return stiffness_N_per_m.at(offset_s - 0.5 * duration_s);
  }
  /// @param contact  for all that does not change
  scene::ContactValues contact_at(double offset_s, scene::ContactValues contact) const {
    const double from_middle_s = offset_s - 0.5 * duration_s;
    contact.coefficient = std::max(0.0, coefficient.at(from_middle_s));
    contact.normal_force_N = std::max(0.0, normal_force_N.at(from_middle_s));
    return contact;
  }
};

}  // namespace sonoglide::loop
