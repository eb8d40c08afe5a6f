/// The stated error bounds of the fixed-point functions, against long double: Q15 over every
/// argument, Q31 over a dense random set, the neighbourhoods of the eighths of the range and its
/// ends.

#include "firmware/numeric/fixed_elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

#include "tests/common/constants/pi.hpp"

namespace sonoglide::numeric::fixed_elementary_test {
namespace {

using tests::long_pi;

template <class Raw>
std::vector<Raw> raw_arguments() {
  constexpr std::int64_t low = std::numeric_limits<Raw>::min();
  constexpr std::int64_t high = std::numeric_limits<Raw>::max();
  std::vector<Raw> result;
  if constexpr (std::is_same_v<Raw, std::int16_t>) {
    for (std::int64_t raw = low; raw <= high; ++raw) {
      result.push_back(static_cast<Raw>(raw));
    }
  } else {
    std::mt19937_64 random(31);
    for (int i = 0; i < 1'500'000; ++i) {
      result.push_back(static_cast<Raw>(static_cast<std::uint32_t>(random())));
    }
    for (std::int64_t eighth = low; eighth <= high + 1; eighth += high / 8 + 1) {
      for (std::int64_t raw = eighth - 2000; raw <= eighth + 2000; ++raw) {
        if (raw >= low && raw <= high) {
          result.push_back(static_cast<Raw>(raw));
        }
      }
    }
  }
  return result;
}

template <class Number>
class FixedElementary : public testing::Test {
 protected:
  /// Largest |function - reference| in LSB over the arguments in [low, high].
  template <class Function, class Reference>
  static double worst_lsb(long double low, long double high, Function function,
                          Reference reference) {
    static const auto raws = raw_arguments<typename Number::Raw>();
    const long double unit = std::ldexp(1.0L, Number::fraction_bits);
    double worst = 0.0;
    std::size_t compared = 0;
    for (const auto raw : raws) {
      const long double x = raw / unit;
      if (x < low || x > high) {
        continue;
      }
      const long double got = function(Number::from_raw(raw)).raw();
      const auto error = static_cast<double>(std::fabs(got - reference(x) * unit));
      worst = error > worst ? error : worst;
      ++compared;
    }
    EXPECT_GE(compared, raws.size() / 3);
    return worst;
  }
};

// Trapping: within its range no function overflows.
using Formats = testing::Types<Q15<Trapping>, Q31<Trapping>>;
TYPED_TEST_SUITE(FixedElementary, Formats, );

TYPED_TEST(FixedElementary, SineIsWithin1Lsb) {
  EXPECT_LE(this->worst_lsb(
                -1.0L, 1.0L, [](TypeParam x) { return sin_pi(x); },
                [](long double x) { return std::sin(long_pi * x); }),
            1.0);
}

TYPED_TEST(FixedElementary, CosineIsWithin1Lsb) {
  EXPECT_LE(this->worst_lsb(
                -1.0L, 1.0L, [](TypeParam x) { return cos_pi(x); },
                [](long double x) { return std::cos(long_pi * x); }),
            1.0);
}

TYPED_TEST(FixedElementary, ArcsineIsWithin1Lsb) {
  EXPECT_LE(this->worst_lsb(
                -1.0L, 1.0L, [](TypeParam x) { return asin_per_pi(x); },
                [](long double x) { return std::asin(x) / long_pi; }),
            1.0);
}

TYPED_TEST(FixedElementary, ExponentialIsWithin1Lsb) {
  EXPECT_LE(this->worst_lsb(
                -1.0L, 0.0L, [](TypeParam x) { return exp(x); },
                [](long double x) { return std::exp(x); }),
            1.0);
}

TYPED_TEST(FixedElementary, SquareRootIsWithinHalfAnLsb) {
  const double bound = std::is_same_v<typename TypeParam::Raw, std::int32_t> ? 0.5 : 0.501;
  EXPECT_LE(this->worst_lsb(
                0.0L, 1.0L, [](TypeParam x) { return sqrt(x); },
                [](long double x) { return std::sqrt(x); }),
            bound);
}

TEST(ShortElementary, InverseAndMonotoneFunctionsNeverStepBack) {
  using Number = Q15<Saturating>;
  for (std::int32_t raw = -32768; raw < 32767; ++raw) {
    const auto x = Number::from_raw(static_cast<std::int16_t>(raw));
    const auto next = Number::from_raw(static_cast<std::int16_t>(raw + 1));
    EXPECT_LE(asin_per_pi(x), asin_per_pi(next));
    EXPECT_LE(exp(x), exp(next));
    EXPECT_LE(sqrt(x), sqrt(next));
  }
}

TEST(FixedElementaryOverflow, IsCountedAndGivesTheNearestEnd) {
  using Number = Q31<Counting>;
  SignalLedger ledger;
  const LedgerScope scope(ledger);
  EXPECT_EQ(exp(Number::from_raw(1)), Number::largest());
  EXPECT_EQ(ledger.pending_saturations, 1U);
  EXPECT_EQ(sqrt(Number::from_raw(-1)), Number());
  EXPECT_EQ(ledger.pending_saturations, 2U);
  EXPECT_EQ(exp(Number()), Number::largest());
  EXPECT_EQ(cos_pi(Number()), Number::largest());
  EXPECT_EQ(ledger.pending_saturations, 2U);
}

TEST(IntegerRoot, IsTheNearestInteger) {
  std::mt19937_64 random(62);
  for (int i = 0; i < 1'000'000; ++i) {
    const std::uint64_t n = random() >> (2 + random() % 62);
    const std::uint64_t root = nearest_root(n);
    ASSERT_LE(n, root * (root + 1)) << n;                  // n < (root + 1/2)^2
    ASSERT_TRUE(root == 0 || n > root * (root - 1)) << n;  // n > (root - 1/2)^2
  }
  for (std::uint64_t root = 1; root < std::uint64_t{1} << 31; root += root / 64 + 1) {
    EXPECT_EQ(nearest_root(root * root), root);
    EXPECT_EQ(nearest_root(root * (root + 1)), root);
    EXPECT_EQ(nearest_root(root * (root - 1) + 1), root);
  }
}

}  // namespace
}  // namespace sonoglide::numeric::fixed_elementary_test
