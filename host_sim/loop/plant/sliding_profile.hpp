/// The sliding velocity of a scene as a function of time.
#pragma once

#include <vector>

#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

class SlidingProfile {
 public:
  explicit SlidingProfile(const scene::Sliding& sliding) : points_(sliding.profile) {}

  double velocity_m_per_s(double time_s) const;

  /// One velocity throughout.
  bool is_constant() const;

  /// Times at which the velocity changes its slope or its sign, rising.
  std::vector<double> cuts_s() const;

 private:
  std::vector<scene::SpeedPoint> points_;
};

}  // namespace sonoglide::loop
