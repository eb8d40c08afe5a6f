/// Points that fill a cube evenly, in an order that a seed sets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sonoglide::robust {

/// Point `index` of a Sobol sequence, scrambled.
///
/// The sequence has the direction numbers of Joe and Kuo (2008), by Boost.Random, in Gray-code order
/// from the point 0 on. The scrambling is Owen's (1995): each binary digit of a coordinate is flipped
/// or not as a hash of the seed, the coordinate and the digits above it says. So the first 2^m points
/// stay a net, and each point by itself is uniform over the seeds.
///
/// Coordinates are odd multiples of 2^-53: none is 0 or 1.
/// @param dimensions  1 to most_dimensions
/// @param count       points 0 to count - 1, one after the other
std::vector<double> scrambled_sobol(std::size_t dimensions, std::size_t count, std::uint64_t seed);

inline constexpr std::size_t most_dimensions = 3667;

}  // namespace sonoglide::robust
