#include "host_sim/loop/plant/sliding_profile.hpp"

#include <algorithm>
#include <cstddef>

namespace sonoglide::loop {

double SlidingProfile::velocity_m_per_s(double time_s) const {
  const auto after = std::upper_bound(
      points_.begin(), points_.end(), time_s,
      [](double time, const scene::SpeedPoint& point) { return time < point.time_s; });
  if (after == points_.begin()) {
    return points_.front().velocity_m_per_s;
  }
  if (after == points_.end()) {
    return points_.back().velocity_m_per_s;
  }
  const scene::SpeedPoint& before = *(after - 1);
  const double part = (time_s - before.time_s) / (after->time_s - before.time_s);
  return before.velocity_m_per_s + part * (after->velocity_m_per_s - before.velocity_m_per_s);
}

bool SlidingProfile::is_constant() const {
  const double first = points_.front().velocity_m_per_s;
  return std::all_of(points_.begin(), points_.end(), [first](const scene::SpeedPoint& point) {
    return point.velocity_m_per_s == first;
  });
}

std::vector<double> SlidingProfile::cuts_s() const {
  std::vector<double> cuts;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    cuts.push_back(points_[i].time_s);
    if (i + 1 < points_.size()) {
      const double first = points_[i].velocity_m_per_s;
      const double last = points_[i + 1].velocity_m_per_s;
      if (first * last < 0.0) {
        cuts.push_back(points_[i].time_s +
                       (points_[i + 1].time_s - points_[i].time_s) * first / (first - last));
      }
    }
  }
  return cuts;
}

}  // namespace sonoglide::loop
