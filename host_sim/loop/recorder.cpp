#include "host_sim/loop/recorder.hpp"

#include <algorithm>
#include <cmath>

namespace sonoglide::loop {
namespace {

/// A sample that is meant to fall on an end may miss it by rounding, relative to the interval.
constexpr double rounding = 1e-9;

}  // namespace

void Recorder::want(double begin_s, double end_s, double interval_s, Recording& into) {
  const double intervals = std::floor((end_s - begin_s) / interval_s + rounding);
  requests_.push_back({begin_s, interval_s, static_cast<std::size_t>(intervals) + 1, &into});
}

std::vector<double> Recorder::plan(double begin_s, double end_s, bool last) {
  planned_.clear();
  for (Request& request : requests_) {
    const double limit_s = end_s + (last ? rounding : -rounding) * request.interval_s;
    for (; request.next < request.count && request.next_time_s() < limit_s; ++request.next) {
      const double offset_s = std::clamp(request.next_time_s() - begin_s, 0.0, end_s - begin_s);
      planned_.push_back({offset_s, request.into});
    }
  }
  std::stable_sort(planned_.begin(), planned_.end(),
                   [](const Planned& a, const Planned& b) { return a.offset_s < b.offset_s; });
  std::vector<double> offsets_s;
  for (const Planned& planned : planned_) {
    offsets_s.push_back(planned.offset_s);
  }
  return offsets_s;
}

void Recorder::take(double begin_s, const Stretch& stretch, const std::vector<PlantState>& seen) {
  for (std::size_t i = 0; i < planned_.size(); ++i) {
    const double offset_s = planned_[i].offset_s;
    const double phase_rad = stretch.drive_phase_rad + stretch.drive_rate_rad_per_s * offset_s;
    Recording& into = *planned_[i].into;
    into.time_s.push_back(begin_s + offset_s);
    into.state.push_back(seen[i]);
    into.drive_force_N.push_back(stretch.drive_amplitude_N * std::cos(phase_rad));
    into.sliding_velocity_m_per_s.push_back(stretch.sliding_velocity_m_per_s +
                                            stretch.sliding_acceleration_m_per_s2 * offset_s);
  }
}

}  // namespace sonoglide::loop
