/// Accumulators: wider than the scalar for 16 bits alone.

#include "firmware/numeric/accumulator.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <type_traits>

namespace sonoglide::numeric::accumulator_test {
namespace {

using Short = Q15<Trapping>;

static_assert(std::is_same_v<Accumulator<double>, double>);
static_assert(std::is_same_v<Accumulator<float>, float>);
static_assert(std::is_same_v<Accumulator<Q31<Trapping>>, Q31<Trapping>>);
static_assert(std::is_same_v<Accumulator<Short>, Q31<Trapping>>);
static_assert(accumulated_product(0.375F, 3.0F) == 1.125F && rounded<float>(0.375F) == 0.375F);

TEST(AccumulatorTest, HoldsEveryProductOfSixteenBitsExactly) {
  for (std::int32_t a = INT16_MIN; a <= INT16_MAX; a += 77) {
    for (std::int32_t b = INT16_MIN + 1; b <= INT16_MAX; b += 79) {
      const auto product = accumulated_product(Short::from_raw(static_cast<std::int16_t>(a)),
                                               Short::from_raw(static_cast<std::int16_t>(b)));
      ASSERT_EQ(product.raw(), 2 * a * b) << a << ' ' << b;
    }
  }
}

TEST(AccumulatorTest, RoundsToNearestOnTheWayBack) {
  const auto third = Q31<Trapping>::from_real(1.0 / 3.0);
  EXPECT_EQ(rounded<Short>(third), Short::from_real(1.0 / 3.0));
  EXPECT_EQ(rounded<Short>(accumulate(Short::lowest())), Short::lowest());
}

}  // namespace
}  // namespace sonoglide::numeric::accumulator_test
