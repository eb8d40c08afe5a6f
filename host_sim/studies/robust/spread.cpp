#include "host_sim/studies/robust/spread.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/random/sobol.hpp>
#include <cmath>

#include "host_sim/studies/splitmix64.hpp"

namespace sonoglide::robust {
namespace {

using studies::mixed;
using studies::splitmix64_step;

constexpr int digits = 52;

/// @param digits_of  the first digits of the coordinate, as an integer
/// @param key        of seed and dimension
double scrambled(std::uint64_t digits_of, std::uint64_t key) {
  std::uint64_t flipped = 0;
  for (int i = 0; i < digits; ++i) {
    // A leading 1 tells prefixes of different lengths apart.
    const std::uint64_t above = (digits_of >> (digits - i)) | (std::uint64_t{1} << i);
    const std::uint64_t flip = mixed(key + splitmix64_step * above) >> 63;
    const int place = digits - 1 - i;
    flipped |= (((digits_of >> place) & 1U) ^ flip) << place;
  }
  return (static_cast<double>(flipped) + 0.5) * 0x1p-52;
}

double deviation(const scene::Tolerance& tolerance) {
  return tolerance.amount * std::abs(tolerance.nominal);
}

/// One of the integers from lowest to highest, each with the same share.
double whole_value(const scene::Tolerance& tolerance, double part) {
  const double count = tolerance.highest - tolerance.lowest + 1.0;
  return std::min(tolerance.lowest + std::floor(part * count), tolerance.highest);
}

double between(double lowest, double highest, double part) {
  // Each end to the bit.
  return part < 0.5 ? lowest + part * (highest - lowest)
                    : highest - (1.0 - part) * (highest - lowest);
}

/// In double: four times as quick as by way of long double, and good to the last digits.
using Normal = boost::math::normal_distribution<
    double, boost::math::policies::policy<boost::math::policies::promote_double<false>>>;

double normal_quantile(const scene::Tolerance& tolerance, double probability) {
  const Normal normal(tolerance.nominal, deviation(tolerance));
  const double below = boost::math::cdf(normal, tolerance.lowest);
  const double above = boost::math::cdf(boost::math::complement(normal, tolerance.highest));
  const double inside = 1.0 - below - above;
  const double value = boost::math::quantile(normal, below + probability * inside);
  return std::clamp(value, tolerance.lowest, tolerance.highest);
}

}  // namespace

std::vector<double> scrambled_sobol(std::size_t dimensions, std::size_t count, std::uint64_t seed) {
  boost::random::sobol engine(dimensions);
  std::vector<std::uint64_t> keys;
  for (std::size_t i = 0; i < dimensions; ++i) {
    keys.push_back(mixed(mixed(seed + splitmix64_step) + splitmix64_step * (i + 1)));
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

double quantile(const scene::Tolerance& tolerance, double probability) {
  if (tolerance.whole) {
    return whole_value(tolerance, probability);
  }
  return tolerance.spread == scene::Spread::normal
             ? normal_quantile(tolerance, probability)
             : between(tolerance.lowest, tolerance.highest, probability);
}

SearchInterval search_interval(const scene::Tolerance& tolerance) {
  if (tolerance.spread != scene::Spread::normal) {
    return {tolerance.lowest, tolerance.highest};
  }
  const double reach = 3.0 * deviation(tolerance);
  return {std::max(tolerance.lowest, tolerance.nominal - reach),
          std::min(tolerance.highest, tolerance.nominal + reach)};
}

double search_value(const scene::Tolerance& tolerance, double part) {
  if (tolerance.whole) {
    return whole_value(tolerance, part);
  }
  const SearchInterval interval = search_interval(tolerance);
  return between(interval.lowest, interval.highest, part);
}

double search_part(const scene::Tolerance& tolerance, double value) {
  const SearchInterval interval = search_interval(tolerance);
  const double half_step = tolerance.whole ? 0.5 : 0.0;
  const double width = interval.highest - interval.lowest + 2.0 * half_step;
  return std::clamp((value - interval.lowest + half_step) / width, 0.0, 1.0);
}

}  // namespace sonoglide::robust
