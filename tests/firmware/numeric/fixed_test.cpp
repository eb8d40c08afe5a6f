/// Rounding, range, conversions and overflow policies of the fixed-point type.

#include "firmware/numeric/fixed.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <type_traits>

namespace sonoglide::numeric::fixed_test {
namespace {

using Short = Q15<Saturating>;
using Long = Q31<Saturating>;
using Mixed = Fixed<std::int32_t, 16, Saturating>;
using Whole = Fixed<std::int16_t, 0, Saturating>;

static_assert(std::is_trivially_copyable_v<Long> && sizeof(Long) == 4 && sizeof(Short) == 2);
static_assert(!std::is_convertible_v<double, Long> && !std::is_constructible_v<Long, double>);
static_assert(!std::is_convertible_v<Short, Long> && !std::is_convertible_v<Long, double>);
static_assert((Long::from_real(0.5) * Long::from_real(-0.25)).to_real() == -0.125);
static_assert((Mixed::from_real(3.0) / Mixed::from_real(-2.0)).to_real() == -1.5);

TEST(FixedRounding, ProductsRoundTiesUpward) {
  const auto half = Short::from_raw(1 << 14);
  EXPECT_EQ((Short::from_raw(1) * half).raw(), 1);    //  0.5 ->  1
  EXPECT_EQ((Short::from_raw(-1) * half).raw(), 0);   // -0.5 ->  0
  EXPECT_EQ((Short::from_raw(3) * half).raw(), 2);    //  1.5 ->  2
  EXPECT_EQ((Short::from_raw(-3) * half).raw(), -1);  // -1.5 -> -1
}

TEST(FixedRounding, QuotientsRoundTiesUpward) {
  const auto two = Whole::from_raw(2);
  const auto minus_two = Whole::from_raw(-2);
  EXPECT_EQ((Whole::from_raw(1) / two).raw(), 1);
  EXPECT_EQ((Whole::from_raw(-1) / two).raw(), 0);
  EXPECT_EQ((Whole::from_raw(3) / minus_two).raw(), -1);
  EXPECT_EQ((Whole::from_raw(-3) / minus_two).raw(), 2);
  EXPECT_EQ((Whole::from_raw(-5) / Whole::from_raw(3)).raw(), -2);
}

TEST(FixedRounding, ConversionsRoundTiesUpward) {
  EXPECT_EQ(fixed_cast<Short>(Long::from_raw(0x8000)).raw(), 1);
  EXPECT_EQ(fixed_cast<Short>(Long::from_raw(-0x8000)).raw(), 0);
  EXPECT_EQ(fixed_cast<Short>(Long::from_raw(-0x8001)).raw(), -1);
  EXPECT_EQ(Whole::from_real(2.5).raw(), 3);
  EXPECT_EQ(Whole::from_real(-2.5).raw(), -2);
  EXPECT_EQ(Whole::from_real(-2.75).raw(), -3);
  EXPECT_EQ(Whole::from_real(0.49999999999999994).raw(), 0);
  EXPECT_EQ(Whole::from_real(-0.5).raw(), 0);
  EXPECT_EQ(Whole::from_real(std::nextafter(-0.5, -1.0)).raw(), -1);
}

TEST(FixedRange, EveryOperationStopsAtTheEnds) {
  EXPECT_EQ(Long::largest() + Long::from_raw(1), Long::largest());
  EXPECT_EQ(Long::lowest() - Long::from_raw(1), Long::lowest());
  EXPECT_EQ(-Long::lowest(), Long::largest());
  EXPECT_EQ(Long::lowest() * Long::lowest(), Long::largest());
  EXPECT_EQ(Long::largest() / Long::from_raw(1), Long::largest());
  EXPECT_EQ(Long::lowest() / Long::from_raw(1), Long::lowest());
}

TEST(FixedRange, CompoundFormsAreTheOperators) {
  auto x = Mixed::from_real(1.5);
  x += Mixed::from_real(2.0);
  EXPECT_EQ(x.to_real(), 3.5);
  x -= Mixed::from_real(0.5);
  EXPECT_EQ(x.to_real(), 3.0);
  x *= Mixed::from_real(-2.0);
  EXPECT_EQ(x.to_real(), -6.0);
  x /= Mixed::from_real(4.0);
  EXPECT_EQ(x.to_real(), -1.5);
}

TEST(FixedRange, ComparisonsAreThoseOfTheRawValues) {
  for (const int a : {-32768, -1, 0, 1, 32767}) {
    for (const int b : {-32768, -1, 0, 1, 32767}) {
      const auto x = Short::from_raw(static_cast<std::int16_t>(a));
      const auto y = Short::from_raw(static_cast<std::int16_t>(b));
      EXPECT_EQ(x == y, a == b);
      EXPECT_EQ(x != y, a != b);
      EXPECT_EQ(x < y, a < b);
      EXPECT_EQ(x <= y, a <= b);
      EXPECT_EQ(x > y, a > b);
      EXPECT_EQ(x >= y, a >= b);
    }
  }
}

TEST(FixedDivision, ByZeroGivesTheEndOnTheDividendsSide) {
  EXPECT_EQ(Long::from_raw(5) / Long(), Long::largest());
  EXPECT_EQ(Long::from_raw(-5) / Long(), Long::lowest());
  EXPECT_EQ(Long() / Long(), Long());
}

TEST(FixedConversion, FromRealStopsAtTheEnds) {
  EXPECT_EQ(Long::from_real(1.0), Long::largest());
  EXPECT_EQ(Long::from_real(-1.0), Long::lowest());
  EXPECT_EQ(Long::from_real(std::numeric_limits<double>::infinity()), Long::largest());
  EXPECT_EQ(Long::from_real(-std::numeric_limits<double>::infinity()), Long::lowest());
  EXPECT_EQ(Long::from_real(std::numeric_limits<double>::quiet_NaN()), Long());
}

TEST(FixedConversion, BetweenRealAndFixedAndBackIsExact) {
  for (std::int32_t raw = -32768; raw < 32768; ++raw) {
    const auto x = Short::from_raw(static_cast<std::int16_t>(raw));
    ASSERT_EQ(Short::from_real(x.to_real()), x);
    ASSERT_EQ(fixed_cast<Short>(fixed_cast<Long>(x)), x);
    ASSERT_EQ(fixed_cast<Mixed>(x).to_real(), x.to_real());
  }
}

TEST(FixedConversion, OverflowIsTheTargets) {
  EXPECT_EQ(fixed_cast<Long>(Mixed::from_real(1.0)), Long::largest());
  EXPECT_EQ(fixed_cast<Long>(Mixed::from_real(-300.0)), Long::lowest());
  EXPECT_EQ(fixed_cast<Short>(Long::largest()), Short::largest());
}

TEST(FixedPolicies, CountingGivesTheSameValuesAndCountsEachClamp) {
  using Counted = Q31<Counting>;
  SignalLedger ledger;
  const LedgerScope scope(ledger);
  std::mt19937 random(5);
  std::uint64_t expected = 0;
  const auto real = [](std::int32_t raw) { return static_cast<long double>(raw) * 0x1p-31L; };
  const auto out_of_range = [](long double x) {
    return x >= 1.0L - 0x1p-32L || x < -1.0L - 0x1p-32L;
  };
  for (int i = 0; i < 200'000; ++i) {
    const auto a = static_cast<std::int32_t>(random());
    const auto b = static_cast<std::int32_t>(random());
    const auto x = Long::from_raw(a);
    const auto y = Long::from_raw(b);
    const auto p = Counted::from_raw(a);
    const auto q = Counted::from_raw(b);
    ASSERT_EQ((p + q).raw(), (x + y).raw());
    ASSERT_EQ((p - q).raw(), (x - y).raw());
    ASSERT_EQ((p * q).raw(), (x * y).raw());
    ASSERT_EQ((p / q).raw(), (x / y).raw());
    expected += out_of_range(real(a) + real(b)) ? 1U : 0U;
    expected += out_of_range(real(a) - real(b)) ? 1U : 0U;
    expected += out_of_range(real(a) / real(b)) ? 1U : 0U;
  }
  EXPECT_EQ(ledger.total_saturations(), expected);
  EXPECT_GT(expected, 0U);
}

TEST(FixedPolicies, CountingCountsEveryKindOfOverflowOnce) {
  using Counted = Q31<Counting>;
  using CountedShort = Q15<Counting>;
  SignalLedger ledger;
  const LedgerScope scope(ledger);
  std::uint64_t expected = 0;
  const auto one_more = [&](auto) { EXPECT_EQ(ledger.total_saturations(), ++expected); };
  one_more(Counted::largest() + Counted::largest());
  one_more(Counted::lowest() - Counted::largest());
  one_more(-Counted::lowest());
  one_more(Counted::lowest() * Counted::lowest());
  one_more(Counted::largest() / Counted::from_raw(1));
  one_more(Counted::largest() / Counted());
  one_more(Counted() / Counted());
  one_more(Counted::from_real(1.0));
  one_more(Counted::from_real(-2.0));
  one_more(Counted::from_real(std::numeric_limits<double>::quiet_NaN()));
  one_more(fixed_cast<CountedShort>(Long::largest()));
  const std::array<CountedShort, 3> ones{CountedShort::lowest(), CountedShort::lowest(),
                                         CountedShort::lowest()};
  one_more(dot(ones, ones));
  EXPECT_EQ(fixed_cast<Counted>(Counted::from_raw(7)), Counted::from_raw(7));
  EXPECT_EQ(ledger.total_saturations(), expected);
}

TEST(FixedPolicies, CountingWithoutALedgerOnlyClamps) {
  EXPECT_EQ(Q15<Counting>::largest() + Q15<Counting>::largest(), Q15<Counting>::largest());
}

TEST(FixedPoliciesDeathTest, TrappingStopsAtTheFirstOverflow) {
  using Trapped = Q31<Trapping>;
  volatile std::int32_t largest = Trapped::largest().raw();
  EXPECT_DEATH(static_cast<void>(Trapped::from_raw(largest) + Trapped::from_raw(1)), "");
  EXPECT_DEATH(static_cast<void>(Trapped::from_raw(largest) / Trapped()), "");
  EXPECT_DEATH(static_cast<void>(-Trapped::lowest()), "");
  EXPECT_DEATH(static_cast<void>(fixed_cast<Q15<Trapping>>(Trapped::from_raw(largest))), "");
  EXPECT_EQ((Trapped::from_raw(largest) + Trapped::lowest()).raw(), -1);
}

TEST(FixedDotProduct, RoundsEachProductAndSaturatesOnce) {
  const auto half = Short::from_raw(1 << 14);
  const std::array<Short, 4> a{Short::from_raw(1), Short::from_raw(1), Short::from_raw(-1), half};
  const std::array<Short, 4> b{half, half, half, half};
  EXPECT_EQ(dot(a, b).raw(), 1 + 1 + 0 + (1 << 13));

  // The first two products leave the range, the third brings the sum back.
  const std::array<Long, 3> c{Long::lowest(), Long::lowest(), Long::lowest()};
  const std::array<Long, 3> d{-Long::largest(), Long::from_real(-0.5), Long::from_real(0.75)};
  EXPECT_EQ(dot(c, d), Long::from_real(0.75) - Long::from_raw(1));
  const std::array<Long, 2> lowest{Long::lowest(), Long::lowest()};
  const std::array<Long, 2> next{-Long::largest(), -Long::largest()};
  EXPECT_EQ(dot(lowest, next), Long::largest());
}

}  // namespace
}  // namespace sonoglide::numeric::fixed_test
