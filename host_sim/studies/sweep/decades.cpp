#include "host_sim/studies/sweep/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "firmware/numeric/float_exponential.hpp"

namespace sonoglide::sweep {
namespace {

constexpr double ln10 = 2.302585092994045684;
constexpr double log10_of_2 = 0.30102999566398119521;

/// 10^n, correctly rounded as texts are when they are read.
double whole_power(int n) {
  constexpr int lowest = -324;
  constexpr int highest = 309;
  static const auto table = [] {
    std::array<double, highest - lowest + 1> powers{};
    for (std::size_t i = 0; i < powers.size(); ++i) {
      powers[i] = std::strtod(fmt::format("1e{}", lowest + static_cast<int>(i)).c_str(), nullptr);
    }
    return powers;
  }();
  return table[static_cast<std::size_t>(std::clamp(n, lowest, highest) - lowest)];
}

}  // namespace

double power_of_ten(double x) {
  const double whole = std::floor(x + 0.5);
  return numeric::exp((x - whole) * ln10) * whole_power(static_cast<int>(whole));
}

double logarithm_to_ten(double x) {
  // Of few digits, so that 10^first is x but for a small rest, and x itself for a power of ten.
  const auto few_digits = static_cast<float>(numeric::log2(x) * log10_of_2);
  const auto first = static_cast<double>(few_digits);
  const double rest = x / power_of_ten(first) - 1.0;
  return first + (rest - 0.5 * rest * rest) / ln10;
}

}  // namespace sonoglide::sweep
