/// A tolerance as a distribution to draw from, by points that fill a cube evenly, and as an interval to
/// search in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "host_sim/scene/tolerance.hpp"

namespace sonoglide::robust {

/// Point `index` of a Sobol sequence, scrambled.
///
/// The sequence has the direction numbers of Joe and Kuo (2008), by Boost.Random, in Gray-code order
/// from the point 0 on. The scrambling is Owen's (1995): each binary digit of a coordinate is flipped
/// or not as a hash of the seed, the coordinate and the digits above it says. So the first 2^m points
/// stay a net, and each point by itself is uniform over the seeds.
///
/// Coordinates are odd multiples of 2^-53: none is 0 or 1.
/// @param dimensions  1 to 3667
/// @param count       points 0 to count - 1, one after the other
std::vector<double> scrambled_sobol(std::size_t dimensions, std::size_t count, std::uint64_t seed);

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
