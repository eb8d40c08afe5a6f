/// Against the C library's fma.
#include "host_sim/runs/batch/fused_by_parts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

namespace sonoglide::batch::fused_by_parts_test {
namespace {

template <class Float>
bool same(Float a, Float b) {
  return (std::isnan(a) && std::isnan(b)) || std::memcmp(&a, &b, sizeof a) == 0;
}

template <class Float>
void expect_fused(Float a, Float b, Float c) {
  Float sum = c;
  fuse(&a, &b, &sum, 1);
  EXPECT_TRUE(same(sum, std::fma(a, b, c))) << a << ' ' << b << ' ' << c << ": " << sum;
}

template <class Float>
class FusedByParts : public testing::Test {};

using Floats = testing::Types<float, double>;
TYPED_TEST_SUITE(FusedByParts, Floats, );

/// Sums that cancel to the last bits, and terms of any size beside each other.
TYPED_TEST(FusedByParts, RoundsOnce) {
  using Float = TypeParam;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<Float> mantissa(-2, 2);
  std::uniform_int_distribution<int> spread(-60, 60);
  constexpr int count = 300000;
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    const Float a = mantissa(random);
    const Float b = mantissa(random);
    const Float near = -a * b *
                       (Float{1} + static_cast<Float>(spread(random) / 16) *
                                       std::numeric_limits<Float>::epsilon());
    expect_fused(a, b, near);
    expect_fused(a, b, std::ldexp(mantissa(random), spread(random)));
  }
}

/// Any bits: half of them at the ends of the range or no numbers at all.
TYPED_TEST(FusedByParts, TakesAnyBits) {
  using Float = TypeParam;
  std::mt19937_64 random(6);
  const auto any = [&random] {
    const std::uint64_t bits = random();
    Float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  };
  constexpr int count = 300000;
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    expect_fused(any(), any(), any());
  }
}

TYPED_TEST(FusedByParts, KeepsSignsOfZeroAndWhatIsNoNumber) {
  using Limits = std::numeric_limits<TypeParam>;
  const std::vector<TypeParam> edges = {0,
                                        1,
                                        Limits::min(),
                                        Limits::denorm_min(),
                                        Limits::max(),
                                        Limits::epsilon(),
                                        Limits::infinity(),
                                        Limits::quiet_NaN()};
  for (const TypeParam a : edges) {
    for (const TypeParam b : edges) {
      for (const TypeParam c : edges) {
        for (const int signs : {0, 1, 2, 3}) {
          expect_fused((signs & 1) != 0 ? -a : a, b, (signs & 2) != 0 ? -c : c);
        }
      }
    }
  }
}

}  // namespace
}  // namespace sonoglide::batch::fused_by_parts_test
