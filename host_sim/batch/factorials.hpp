/// Coefficients of the power series of exponential, sine and cosine.
#pragma once

#include <array>
#include <cstddef>

namespace sonoglide::batch {

/// 1 / n! for n in [0, 24].
inline constexpr std::array<double, 25> reciprocal_factorials = [] {
  std::array<double, 25> table{};
  double factorial = 1.0;
  for (std::size_t n = 0; n < table.size(); ++n) {
    factorial *= n == 0 ? 1.0 : static_cast<double>(n);
    table[n] = 1.0 / factorial;
  }
  return table;
}();

}  // namespace sonoglide::batch
