/// The sliding velocity of a scene as a function of time.
#pragma once

#include <vector>

#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

class SlidingProfile {
 public:
  explicit SlidingProfile(const scene::Sliding& sliding) : points_(sliding.profile) {}
  /// What a stretch says of the sliding: with a load, the velocity of the pulled end of its spring.
  static SlidingProfile of(const scene::Scene& scene) {
    if (!scene.load) {
      return SlidingProfile(scene.sliding);
    }
    const auto& pull = scene.load->pull_profile_m_per_s;
    return SlidingProfile(
        scene::Sliding{pull.empty() ? std::vector<scene::SpeedPoint>{{0.0, 0.0}} : pull});
  }

  double velocity_m_per_s(double time_s) const;

  /// One velocity throughout.
  bool is_constant() const;

  /// Times at which the velocity changes its slope or its sign, rising.
  std::vector<double> cuts_s() const;

 private:
  std::vector<scene::SpeedPoint> points_;
};

}  // namespace sonoglide::loop
