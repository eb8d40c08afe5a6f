/// A number of a scene that changes in time.
#pragma once

#include <vector>

namespace sonoglide::scene {

struct TimedValue {
  double time_s = 0.0;
  double value = 0.0;
};

/// Linear between the rows and constant outside them; a jump is two rows of one time. Times do not
/// fall.
using TimedProfile = std::vector<TimedValue>;

/// At a jump, the value after it.
double value_at(const TimedProfile& profile, double time_s);

double smallest_value(const TimedProfile& profile);
double largest_value(const TimedProfile& profile);

/// |d value / dt| [1/s] over the larger of the values at the ends of the line that holds at a time
/// between two rows; 0 outside them, and where nothing changes.
double relative_slope_per_s(const TimedProfile& profile, double time_s);

}  // namespace sonoglide::scene
