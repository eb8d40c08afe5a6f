/// The four fixed-point operations against integer arithmetic: 16 bit over every pair of operands,
/// 32 bit over every pair of edge values and 10^8 random pairs.
///
/// One oracle serves all: an operation's exact result is a fraction, and the stored result must be
/// the multiple of the unit that is nearest to it, ties upward, or the end of the range before it.

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "firmware/numeric/fixed.hpp"

namespace sonoglide::numeric::exhaustive_test {
namespace {

__extension__ typedef __int128 Int128;

template <class Raw, class Wide>
bool is_nearest_in_range(Wide numerator, Wide denominator, Wide result) {
  if (denominator < 0) {
    numerator = -numerator;
    denominator = -denominator;
  }
  const Wide twice_error = 2 * (numerator - result * denominator);
  const bool high_enough =
      (result == std::numeric_limits<Raw>::min()) | (twice_error >= -denominator);
  const bool low_enough = (result == std::numeric_limits<Raw>::max()) | (twice_error < denominator);
  return high_enough & low_enough;
}

template <class Raw, class Wide>
bool is_right_quotient(Wide a, Wide b, Wide unit, Wide result) {
  if (b != 0) {
    return is_nearest_in_range<Raw, Wide>(a * unit, b, result);
  }
  if (a == 0) {
    return result == 0;
  }
  return result == (a < 0 ? std::numeric_limits<Raw>::min() : std::numeric_limits<Raw>::max());
}

using Short = Q15<Saturating>;

/// Pairs, of all 2^32, for which `is_right(a, b)` is false.
template <class IsRight>
std::int64_t wrong_pairs(IsRight is_right) {
  std::int64_t wrong = 0;
  for (std::int32_t a = -32768; a < 32768; ++a) {
    std::int32_t wrong_here = 0;
    for (std::int32_t b = -32768; b < 32768; ++b) {
      wrong_here += is_right(a, b) ? 0 : 1;
    }
    wrong += wrong_here;
  }
  return wrong;
}

Short short_of(std::int32_t raw) {
  return Short::from_raw(static_cast<std::int16_t>(raw));
}

TEST(EveryPairOf16Bit, Adds) {
  EXPECT_EQ(wrong_pairs([](std::int32_t a, std::int32_t b) {
              const std::int32_t result = (short_of(a) + short_of(b)).raw();
              return is_nearest_in_range<std::int16_t, std::int32_t>(a + b, 1, result);
            }),
            0);
}

TEST(EveryPairOf16Bit, Subtracts) {
  EXPECT_EQ(wrong_pairs([](std::int32_t a, std::int32_t b) {
              const std::int32_t result = (short_of(a) - short_of(b)).raw();
              return is_nearest_in_range<std::int16_t, std::int32_t>(a - b, 1, result);
            }),
            0);
}

TEST(EveryPairOf16Bit, Multiplies) {
  EXPECT_EQ(wrong_pairs([](std::int32_t a, std::int32_t b) {
              const std::int32_t result = (short_of(a) * short_of(b)).raw();
              return is_nearest_in_range<std::int16_t, std::int32_t>(a * b, 1 << 15, result);
            }),
            0);
}

TEST(EveryPairOf16Bit, Divides) {
  EXPECT_EQ(wrong_pairs([](std::int32_t a, std::int32_t b) {
              const std::int64_t result = (short_of(a) / short_of(b)).raw();
              return is_right_quotient<std::int16_t, std::int64_t>(a, b, 1 << 15, result);
            }),
            0);
}

using Long = Q31<Saturating>;

/// Powers of two and the ends of the range, each with its neighbours.
std::vector<std::int32_t> edge_values() {
  std::vector<std::int32_t> edges{std::numeric_limits<std::int32_t>::min(),
                                  std::numeric_limits<std::int32_t>::min() + 1,
                                  std::numeric_limits<std::int32_t>::max()};
  for (int bit = 0; bit < 31; ++bit) {
    for (std::int32_t offset = -2; offset <= 2; ++offset) {
      const std::int32_t power = std::int32_t{1} << bit;
      edges.push_back(power - 1 + offset);
      edges.push_back(-power + offset);
    }
  }
  return edges;
}

/// A random 32-bit value of random width, so that small values are met as often as large ones.
std::int32_t of_random_width(std::uint32_t bits, unsigned width) {
  return static_cast<std::int32_t>(bits) >> (width & 31U);
}

template <class IsRight>
std::int64_t wrong_among_edges_and_random(IsRight is_right) {
  std::int64_t wrong = 0;
  const std::vector<std::int32_t> edges = edge_values();
  for (const std::int32_t a : edges) {
    for (const std::int32_t b : edges) {
      wrong += is_right(a, b) ? 0 : 1;
    }
  }
  std::mt19937_64 random;
  for (int i = 0; i < 100'000'000; ++i) {
    const std::uint64_t bits = random();
    const auto widths = static_cast<unsigned>(random());
    const std::int32_t a = of_random_width(static_cast<std::uint32_t>(bits), widths);
    const std::int32_t b = of_random_width(static_cast<std::uint32_t>(bits >> 32), widths >> 5);
    wrong += is_right(a, b) ? 0 : 1;
  }
  return wrong;
}

TEST(EdgesAndRandomPairsOf32Bit, Add) {
  EXPECT_EQ(wrong_among_edges_and_random([](std::int32_t a, std::int32_t b) {
              const Int128 result = (Long::from_raw(a) + Long::from_raw(b)).raw();
              return is_nearest_in_range<std::int32_t, Int128>(Int128{a} + b, 1, result);
            }),
            0);
}

TEST(EdgesAndRandomPairsOf32Bit, Subtract) {
  EXPECT_EQ(wrong_among_edges_and_random([](std::int32_t a, std::int32_t b) {
              const Int128 result = (Long::from_raw(a) - Long::from_raw(b)).raw();
              return is_nearest_in_range<std::int32_t, Int128>(Int128{a} - b, 1, result);
            }),
            0);
}

TEST(EdgesAndRandomPairsOf32Bit, Multiply) {
  EXPECT_EQ(wrong_among_edges_and_random([](std::int32_t a, std::int32_t b) {
              const Int128 result = (Long::from_raw(a) * Long::from_raw(b)).raw();
              return is_nearest_in_range<std::int32_t, Int128>(Int128{a} * b, Int128{1} << 31,
                                                               result);
            }),
            0);
}

TEST(EdgesAndRandomPairsOf32Bit, Divide) {
  EXPECT_EQ(wrong_among_edges_and_random([](std::int32_t a, std::int32_t b) {
              const Int128 result = (Long::from_raw(a) / Long::from_raw(b)).raw();
              return is_right_quotient<std::int32_t, Int128>(a, b, Int128{1} << 31, result);
            }),
            0);
}

}  // namespace
}  // namespace sonoglide::numeric::exhaustive_test
