#include "host_sim/studies/design/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sonoglide::design {

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : std::string("-");
}

std::string quantity(double value, const char* unit) {
  if (!std::isfinite(value) || value == 0.0) {
    return std::isfinite(value) ? fmt::format("0 {}", unit) : std::string("-");
  }
  static constexpr const char* prefixes[] = {"p", "n", "u", "m", "", "k", "M", "G"};
  constexpr int without = 4;
  constexpr int last = 7;
  // What rounds to 1000 has the next prefix.
  const double thousands = std::floor(std::log10(std::abs(value) * (1.0 + 5e-5)) / 3.0);
  const int index = std::clamp(static_cast<int>(thousands) + without, 0, last);
  return fmt::format("{:.4g} {}{}", value * std::pow(1000.0, without - index), prefixes[index],
                     unit);
}

}  // namespace sonoglide::design
