#include "host_sim/scene/timed_profile.hpp"

#include <algorithm>

namespace sonoglide::scene {
namespace {

bool smaller(const TimedValue& one, const TimedValue& other) {
  return one.value < other.value;
}

/// The first row after a time.
TimedProfile::const_iterator row_after(const TimedProfile& profile, double time_s) {
  return std::upper_bound(profile.begin(), profile.end(), time_s,
                          [](double time, const TimedValue& row) { return time < row.time_s; });
}

}  // namespace

double value_at(const TimedProfile& profile, double time_s) {
  const auto after = row_after(profile, time_s);
  if (after == profile.begin()) {
    return profile.front().value;
  }
  if (after == profile.end()) {
    return profile.back().value;
  }
  const TimedValue& before = *(after - 1);
  const double part = (time_s - before.time_s) / (after->time_s - before.time_s);
  return before.value + part * (after->value - before.value);
}

double smallest_value(const TimedProfile& profile) {
  return std::min_element(profile.begin(), profile.end(), smaller)->value;
}

double largest_value(const TimedProfile& profile) {
  return std::max_element(profile.begin(), profile.end(), smaller)->value;
}

}  // namespace sonoglide::scene
