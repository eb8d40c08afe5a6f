/// A number of a scene that changes in time.
#pragma once

#include <vector>

namespace sonoglide::scene {

/// A row of a number that changes in time.
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

}  // namespace sonoglide::scene
