#include "host_sim/studies/robust/spread.hpp"

#include <boost/random/sobol.hpp>

namespace sonoglide::robust {
namespace {

/// The last step of the generator splitmix64 (Steele, Lea and Flood 2014): every bit of the input
/// reaches every bit of the result.
std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31);
}

constexpr std::uint64_t golden = 0x9e3779b97f4a7c15U;
constexpr int digits = 52;

/// @param digits_of  the first digits of the coordinate, as an integer
/// @param key        of seed and dimension
double scrambled(std::uint64_t digits_of, std::uint64_t key) {
  std::uint64_t flipped = 0;
  for (int i = 0; i < digits; ++i) {
    // A leading 1 tells prefixes of different lengths apart.
    const std::uint64_t above = (digits_of >> (digits - i)) | (std::uint64_t{1} << i);
    const std::uint64_t flip = mixed(key + golden * above) >> 63;
    const int place = digits - 1 - i;
    flipped |= (((digits_of >> place) & 1U) ^ flip) << place;
  }
  return (static_cast<double>(flipped) + 0.5) * 0x1p-52;
}

}  // namespace

std::vector<double> scrambled_sobol(std::size_t dimensions, std::size_t count, std::uint64_t seed) {
  boost::random::sobol engine(dimensions);
  std::vector<std::uint64_t> keys;
  for (std::size_t i = 0; i < dimensions; ++i) {
    keys.push_back(mixed(mixed(seed + golden) + golden * (i + 1)));
  }
  std::vector<double> points;
  points.reserve(dimensions * count);
  for (std::size_t index = 0; index < count; ++index) {
    for (const std::uint64_t key : keys) {
      // Boost leaves the point 0 out, without which the first 2^m points are no net.
      const std::uint64_t whole = index == 0 ? 0 : engine();
      points.push_back(scrambled(whole >> (64 - digits), key));
    }
  }
  return points;
}

}  // namespace sonoglide::robust
