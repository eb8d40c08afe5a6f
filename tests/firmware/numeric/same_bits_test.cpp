/// Every elementary function gives the same bits whatever the compiler and its optimisation: a hash
/// of many results is compared with the value that every build so far has had.
///
/// A deliberate change of a function changes its hash; anything else that does is a fault.

#include <gtest/gtest.h>

#include <cstdint>

#include "firmware/numeric/fixed_elementary.hpp"
#include "firmware/numeric/float_elementary.hpp"

namespace sonoglide::numeric::same_bits_test {
namespace {

/// FNV-1a of the results of `function` at `count` arguments from low in equal steps.
template <class Number, class Function>
std::uint64_t hash_of(Function function, Number low, Number step, int count = 20'000) {
  std::uint64_t hash = 0xCBF29CE484222325U;
  Number x = low;
  for (int i = 0; i < count; ++i, x += step) {
    std::uint64_t bits = 0;
    if constexpr (is_fixed_point_v<Number>) {
      bits = static_cast<std::uint64_t>(function(x).raw());
    } else {
      bits = to_bits(function(x));
    }
    for (int byte = 0; byte < 8; ++byte, bits >>= 8) {
      hash = (hash ^ (bits & 0xFFU)) * 0x100000001B3U;
    }
  }
  return hash;
}

struct Golden {
  std::uint64_t as_float;
  std::uint64_t as_double;
};

template <class Function>
void expect_float_hashes(Function function, double low, double high, Golden golden) {
  const double step = (high - low) / 20'000;
  EXPECT_EQ(hash_of(function, static_cast<float>(low), static_cast<float>(step)), golden.as_float);
  EXPECT_EQ(hash_of(function, low, step), golden.as_double);
}

TEST(SameBits, Sine) {
  expect_float_hashes([](auto x) { return sin(x); }, -100.0, 100.0,
                      {0x97F579CB1A4C8B4EU, 0x1DDD560967CF9E6AU});
}
TEST(SameBits, Cosine) {
  expect_float_hashes([](auto x) { return cos(x); }, -100.0, 100.0,
                      {0x4EC89BB110BE0A72U, 0x444C1FF1C6DB392AU});
}
TEST(SameBits, SineOfHalfTurns) {
  expect_float_hashes([](auto x) { return sin_pi(x); }, -3.0, 3.0,
                      {0x54FACBF4F1B6CCB5U, 0x8DB9EAEE41A34B5AU});
}
TEST(SameBits, CosineOfHalfTurns) {
  expect_float_hashes([](auto x) { return cos_pi(x); }, -3.0, 3.0,
                      {0x4A995054AA05D8FBU, 0x6A676C6FE854F348U});
}
TEST(SameBits, Exponential) {
  expect_float_hashes([](auto x) { return exp(x); }, -105.0, 80.0,
                      {0xD7B76AB10EC03791U, 0xE89D514987B737B4U});
}
TEST(SameBits, ExponentialMinusOne) {
  expect_float_hashes([](auto x) { return expm1(x); }, -3.0, 3.0,
                      {0xF821F402A9FDBE5DU, 0xA4EA7D554F0762E6U});
}
TEST(SameBits, PowerOfTwo) {
  expect_float_hashes([](auto x) { return exp2(x); }, -150.0, 120.0,
                      {0x923D9D2432B8C216U, 0xBCA65474BB4596CFU});
}
TEST(SameBits, BinaryLogarithm) {
  expect_float_hashes([](auto x) { return log2(x); }, 0.001, 5.0,
                      {0xC934D058E46CBA51U, 0xEEA70D2705918E82U});
}
TEST(SameBits, Arcsine) {
  expect_float_hashes([](auto x) { return asin(x); }, -0.999, 0.999,
                      {0x37A96BCFF658D213U, 0x7F2C81C326A3BECCU});
}
TEST(SameBits, Arccosine) {
  expect_float_hashes([](auto x) { return acos(x); }, -0.999, 0.999,
                      {0xDA36E423203A1EA4U, 0xBF9C58A4BF97548DU});
}
TEST(SameBits, ArcsinePerPi) {
  expect_float_hashes([](auto x) { return asin_per_pi(x); }, -0.999, 0.999,
                      {0xCA5E70267B235A2CU, 0xEC3DF2399366C49EU});
}
TEST(SameBits, SquareRoot) {
  expect_float_hashes([](auto x) { return sqrt(x); }, 0.001, 5.0,
                      {0xF900C7C0A7DCC398U, 0x2C4CFD17F19ED65CU});
}

struct FixedGolden {
  std::uint64_t as_q15;
  std::uint64_t as_q31;
};

/// 20 000 arguments from -1 up to 0, where every function is at home.
template <class Function>
void expect_fixed_hashes(Function function, FixedGolden golden) {
  using Short = Q15<Saturating>;
  using Long = Q31<Saturating>;
  EXPECT_EQ(hash_of(function, Short::lowest(), Short::from_raw(1)), golden.as_q15);
  EXPECT_EQ(hash_of(function, Long::lowest(), Long::from_raw(107'000)), golden.as_q31);
}

TEST(SameBits, FixedSine) {
  expect_fixed_hashes([](auto x) { return sin_pi(x); }, {0x198B506F67C3B195U, 0x25D1871914BB884AU});
}
TEST(SameBits, FixedCosine) {
  expect_fixed_hashes([](auto x) { return cos_pi(x); }, {0xAB30C9DFFCA2E0AU, 0x7563EFE0FB5795ECU});
}
TEST(SameBits, FixedArcsine) {
  expect_fixed_hashes([](auto x) { return asin_per_pi(x); },
                      {0xA32872EF969ACB54U, 0xA062503264F7E348U});
}
TEST(SameBits, FixedExponential) {
  expect_fixed_hashes([](auto x) { return exp(x); }, {0x972C90917C8278A8U, 0xACB70E9511E73C75U});
}
TEST(SameBits, FixedSquareRoot) {
  expect_fixed_hashes([](auto x) { return sqrt(-x); }, {0x80258D78555DA97BU, 0x4D0B8D11A21ED3F1U});
}

}  // namespace
}  // namespace sonoglide::numeric::same_bits_test
