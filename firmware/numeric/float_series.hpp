/// Polynomials whose coefficients are known at compile time, and those of the elementary functions by their Taylor series.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

namespace sonoglide::numeric {

/// Sum of coefficients[k] * x^k: even and odd powers are two independent Horner chains.
template <class Float, std::size_t Terms>
constexpr Float polynomial(const std::array<Float, Terms>& coefficients, Float x) {
  static_assert(Terms % 2 == 0, "the two chains are of equal length");
  const Float square = x * x;
  Float even = coefficients[Terms - 2];
  Float odd = coefficients[Terms - 1];
  for (std::size_t pair = Terms / 2 - 1; pair-- > 0;) {
    even = even * square + coefficients[2 * pair];
    odd = odd * square + coefficients[2 * pair + 1];
  }
  return even + x * odd;
}

namespace detail {

template <class Float>
inline constexpr bool is_double = std::is_same_v<Float, double>;

/// (-1)^j / (first + 2 j)!, the Taylor series of sine (first = 3) and cosine (first = 4) after
/// their leading terms, both in x^2. Every factorial in reach is exact in double.
/// At compile time.
template <class Float, std::size_t Terms>
constexpr std::array<Float, Terms> alternating_factorials(int first, double sign) {
  std::array<Float, Terms> result{};
  double factorial = 1.0;
  for (int k = 2; k <= first; ++k) {
    factorial *= k;
  }
  for (std::size_t j = 0; j < Terms; ++j) {
    result[j] = static_cast<Float>(sign / factorial);
    const int next = first + 2 * static_cast<int>(j) + 1;
    factorial *= static_cast<double>(next) * (next + 1);
    sign = -sign;
  }
  return result;
}

/// 1 / (j + 2)!, the Taylor series of the exponential after 1 + x.
/// At compile time.
template <class Float, std::size_t Terms>
constexpr std::array<Float, Terms> exponential_series() {
  std::array<Float, Terms> result{};
  double factorial = 2.0;
  for (std::size_t j = 0; j < Terms; ++j) {
    result[j] = static_cast<Float>(1.0 / factorial);
    factorial *= static_cast<double>(j + 3);
  }
  return result;
}

/// 2 / (2 j + 3), the series of log((1 + s) / (1 - s)) = 2 s + s^3 (...) in s^2.
/// At compile time.
template <class Float, std::size_t Terms>
constexpr std::array<Float, Terms> logarithm_series() {
  std::array<Float, Terms> result{};
  for (std::size_t j = 0; j < Terms; ++j) {
    result[j] = static_cast<Float>(2.0 / static_cast<double>(2 * j + 3));
  }
  return result;
}

/// (2k)! / (4^k k!^2 (2k + 1)), k = j + 1, the Taylor series of the arcsine after x, in x^2.
/// At compile time.
template <class Float, std::size_t Terms>
constexpr std::array<Float, Terms> arcsine_series() {
  std::array<Float, Terms> result{};
  double central = 1.0;
  for (std::size_t j = 0; j < Terms; ++j) {
    const double k = static_cast<double>(j + 1);
    central *= (2.0 * k - 1.0) / (2.0 * k);
    result[j] = static_cast<Float>(central / (2.0 * k + 1.0));
  }
  return result;
}

// Terms: the first one left out is below a quarter ulp at the end of the reduced range.
template <class Float>
inline constexpr auto sine_coefficients =
    alternating_factorials<Float, is_double<Float> ? 8 : 4>(3, -1.0);
template <class Float>
inline constexpr auto cosine_coefficients =
    alternating_factorials<Float, is_double<Float> ? 8 : 4>(4, 1.0);
template <class Float>
inline constexpr auto exponential_coefficients =
    exponential_series<Float, is_double<Float> ? 12 : 6>();
template <class Float>
inline constexpr auto logarithm_coefficients = logarithm_series<Float, is_double<Float> ? 10 : 4>();
template <class Float>
inline constexpr auto arcsine_coefficients = arcsine_series<Float, is_double<Float> ? 24 : 10>();

}  // namespace detail

}  // namespace sonoglide::numeric
