#include "host_sim/runs/batch/fused_by_parts.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace sonoglide::batch {
namespace {

/// A value and what rounding has taken from it: their sum is exact.
struct Exact {
  double value;
  double rest;
};

/// Knuth's sum.
inline Exact sum(double a, double b) {
  const double value = a + b;
  const double of_b = value - a;
  return {value, (a - (value - of_b)) + (b - of_b)};
}

/// Its upper 26 bits, by Veltkamp.
inline double upper_half(double a) {
  const double scaled = 0x1.0000002p27 * a;
  return scaled - (scaled - a);
}

/// Dekker's product.
inline Exact product(double a, double b) {
  const double value = a * b;
  const double a1 = upper_half(a);
  const double b1 = upper_half(b);
  const double a2 = a - a1;
  const double b2 = b - b1;
  return {value, ((a1 * b1 - value) + a1 * b2 + a2 * b1) + a2 * b2};
}

inline std::uint64_t bits_of(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

/// a + b, finite; where that is between two numbers, the one whose last bit is 1. To round it once
/// more, to at least two bits less, is to round the sum itself. Without a branch: none could be
/// foretold.
inline double odd_sum(double a, double b) {
  constexpr int sign_bit = 63;
  const Exact exact = sum(a, b);
  const std::uint64_t bits = bits_of(exact.value);
  const std::uint64_t rest = bits_of(exact.rest);
  const std::uint64_t is_inexact = ((rest << 1U) | (0 - (rest << 1U))) >> sign_bit;
  const std::uint64_t is_toward_0 = (bits ^ rest) >> sign_bit;
  const std::uint64_t step = 1 - 2 * is_toward_0;
  const std::uint64_t odd = bits + (step & (0 - (is_inexact & ~bits)));
  double value = 0.0;
  std::memcpy(&value, &odd, sizeof value);
  return value;
}

/// Whether no part of a product or a sum of such numbers overflows, of a product underflows, or is a
/// zero whose sign counts.
inline bool has_room(double a, double b, double c) {
  constexpr double large = 0x1p900;
  const double size = std::abs(a * b);
  const double size_a = std::abs(a);
  const double size_b = std::abs(b);
  const double size_c = std::abs(c);
  const bool is_zero = (a == 0.0) | (b == 0.0);
  return (is_zero ? c != 0.0 : size >= 0x1p-900) & (size <= large) & (size_a <= large) &
         (size_b <= large) & (size_c <= large);
}
inline bool has_room(float a, float b, float c) {
  const bool finite_a = std::isfinite(a);
  const bool finite_b = std::isfinite(b);
  const bool finite_c = std::isfinite(c);
  return finite_a & finite_b & finite_c;
}

/// @param a, b, c  with room
inline double fused(double a, double b, double c) {
  const Exact of_product = product(a, b);
  const Exact low = sum(c, of_product.rest);
  const Exact high = sum(low.value, of_product.value);
  return high.value + odd_sum(low.rest, high.rest);
}
/// The product of two floats is a double.
inline float fused(float a, float b, float c) {
  return static_cast<float>(
      odd_sum(static_cast<double>(a) * static_cast<double>(b), static_cast<double>(c)));
}

template <class Float>
void fuse_all(const Float* a, const Float* b, Float* sums, std::size_t count) {
  bool all_have_room = true;
  for (std::size_t i = 0; i < count; ++i) {
    all_have_room &= has_room(a[i], b[i], sums[i]);
  }
  if (all_have_room) {
    for (std::size_t i = 0; i < count; ++i) {
      sums[i] = fused(a[i], b[i], sums[i]);
    }
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    sums[i] =
        has_room(a[i], b[i], sums[i]) ? fused(a[i], b[i], sums[i]) : std::fma(a[i], b[i], sums[i]);
  }
}

}  // namespace

void fuse(const double* a, const double* b, double* sums, std::size_t count) {
  fuse_all(a, b, sums, count);
}

void fuse(const float* a, const float* b, float* sums, std::size_t count) {
  fuse_all(a, b, sums, count);
}

}  // namespace sonoglide::batch
