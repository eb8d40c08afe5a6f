/// A tolerance as a distribution to draw from, and as an interval to search in.
#pragma once

#include "host_sim/scene/tolerance.hpp"

namespace sonoglide::robust {

/// The true value at a place of the distribution: half widths and ranges are uniform, integers among
/// them equally likely; a normal one is cut off at the ends of its key's range.
/// @param probability  in (0, 1)
double quantile(const scene::Tolerance& tolerance, double probability);

/// Ends of what the search for the worst plant tries.
struct SearchInterval {
  double lowest;
  double highest;
};

/// The tolerance itself; of a normal one three standard deviations, which hold 99.7 % of it.
SearchInterval search_interval(const scene::Tolerance& tolerance);

/// The true value at a part of this interval: at 0 and 1 its ends, to the bit.
double search_value(const scene::Tolerance& tolerance, double part);

/// The part of the interval at which a value is, in [0, 1].
double search_part(const scene::Tolerance& tolerance, double value);

}  // namespace sonoglide::robust
