/// One step of the Gragg–Bulirsch–Stoer extrapolation method.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace sonoglide::work_precision {

template <std::size_t Size>
using Vector = std::array<long double, Size>;

template <std::size_t Size>
struct Extrapolated {
  Vector<Size> value;  ///< of order 2 columns
  long double error;   ///< largest difference from the value of order 2 (columns - 1)
};

namespace detail {

template <std::size_t Size>
Vector<Size> sum(const Vector<Size>& x, long double factor, const Vector<Size>& y) {
  Vector<Size> result;
  for (std::size_t i = 0; i < Size; ++i) {
    result[i] = x[i] + factor * y[i];
  }
  return result;
}

/// Modified midpoint rule over `length` in `count` steps, an even number.
template <std::size_t Size, class RightHandSide>
Vector<Size> modified_midpoint(const RightHandSide& slope, long double begin, const Vector<Size>& x,
                               long double length, int count) {
  const long double step = length / count;
  Vector<Size> last = x;
  Vector<Size> now = sum(x, step, slope(begin, x));
  for (int i = 1; i < count; ++i) {
    const Vector<Size> next = sum(last, 2.0L * step, slope(begin + i * step, now));
    last = now;
    now = next;
  }
  return now;
}

}  // namespace detail

/// x(begin + length) for x' = slope(t, x), from modified midpoint rules with 2, 4, 6, … steps,
/// extrapolated to step 0 in the square of the step.
///
/// @param columns  2 to 16
/// Source: J. Stoer, R. Bulirsch, Introduction to Numerical Analysis, section 7.2.14.
template <std::size_t Size, class RightHandSide>
Extrapolated<Size> gragg_bulirsch_stoer(const RightHandSide& slope, long double begin,
                                        const Vector<Size>& x, long double length, int columns) {
  std::array<Vector<Size>, 16> row{};  // the last row of the tableau, its highest order first
  long double error = 0.0L;
  for (int j = 0; j < columns; ++j) {
    Vector<Size> entry = detail::modified_midpoint(slope, begin, x, length, 2 * (j + 1));
    error = 0.0L;
    for (int i = 0; i <= j; ++i) {
      const auto column = static_cast<std::size_t>(i);
      const Vector<Size> above = row[column];
      row[column] = entry;
      if (i == j) {
        break;
      }
      const long double ratio = static_cast<long double>(j + 1) / static_cast<long double>(j - i);
      const long double weight = 1.0L / (ratio * ratio - 1.0L);
      error = 0.0L;
      for (std::size_t n = 0; n < Size; ++n) {
        const long double correction = weight * (entry[n] - above[n]);
        entry[n] += correction;
        error = std::max(error, std::abs(correction));
      }
    }
  }
  return {row[static_cast<std::size_t>(columns) - 1], error};
}

}  // namespace sonoglide::work_precision
