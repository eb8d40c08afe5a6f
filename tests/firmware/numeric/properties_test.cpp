/// Properties that hold for every argument, on generated ones.

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "firmware/numeric/fixed_elementary.hpp"
#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::numeric::properties_test {
namespace {

using Long = Q31<Saturating>;

/// Any bits alike from the first case on, where arbitrary alone starts with small numbers.
template <class Integer>
Integer any_bits() {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<Integer>());
}

Long any_long() {
  return Long::from_raw(any_bits<std::int32_t>());
}

double any_between(double low, double high) {
  const auto bits = any_bits<std::uint64_t>();
  return low + (high - low) * (static_cast<double>(bits >> 11) * 0x1p-53);
}

RC_GTEST_PROP(FixedProperty, AdditionAndMultiplicationCommute, ()) {
  const Long a = any_long();
  const Long b = any_long();
  RC_ASSERT(a + b == b + a);
  RC_ASSERT(a * b == b * a);
}

RC_GTEST_PROP(FixedProperty, ZeroAndOrderBehaveAsInTheReals, ()) {
  const Long a = any_long();
  const Long b = any_long();
  const Long c = any_long();
  RC_ASSERT(a + Long() == a);
  RC_ASSERT(a - a == Long());
  RC_ASSERT(a * Long() == Long());
  RC_PRE(a <= b);
  RC_ASSERT(a + c <= b + c);
  RC_ASSERT(a - c <= b - c);
  RC_ASSERT(half(a) <= half(b));
}

RC_GTEST_PROP(FixedProperty, DivisionUndoesMultiplicationWithinRounding, ()) {
  const Long a = any_long();
  const Long b = any_long();
  RC_PRE(std::abs(b.to_real()) > 0.25);
  // Half an LSB of the product is at most 2 LSB of the quotient, which rounds by another half.
  const std::int64_t difference = std::int64_t{((a * b) / b).raw()} - a.raw();
  RC_ASSERT(std::abs(difference) <= 2);
}

RC_GTEST_PROP(FixedProperty, SplitAndScaleAreInverse, ()) {
  const Long x = any_long();
  RC_PRE(x > Long());
  const auto parts = split(x);
  RC_ASSERT(parts.mantissa.to_real() >= 0.5);
  RC_ASSERT(scale_by_power_of_two(parts.mantissa, parts.exponent) == x);
}

RC_GTEST_PROP(FixedProperty, SquareRootNeverStepsBack, ()) {
  const Long a = any_long();
  const Long b = any_long();
  RC_PRE(a >= Long() && a <= b);
  RC_ASSERT(sqrt(a) <= sqrt(b));
}

RC_GTEST_PROP(FixedProperty, SineAndCosineLieOnTheCircle, ()) {
  const Long x = any_long();
  const double sine = sin_pi(x).to_real();
  const double cosine = cos_pi(x).to_real();
  // An LSB off in each: twice (|sin| + |cos|) LSB at most.
  RC_ASSERT(std::abs(sine * sine + cosine * cosine - 1.0) <= 2.0 * 1.4143 * 0x1p-31);
}

RC_GTEST_PROP(FixedProperty, ArcsineUndoesSine, ()) {
  const Long x = half(any_long());
  RC_PRE(std::abs(x.to_real()) < 0.4);
  // The slope of asin_per_pi there is below 1.04 and it is an LSB off itself.
  const std::int64_t difference = std::int64_t{asin_per_pi(sin_pi(x)).raw()} - x.raw();
  RC_ASSERT(std::abs(difference) <= 3);
}

RC_GTEST_PROP(CodeProperty, RoundTripIsExactInDoubleAndQ31, ()) {
  const auto code = any_bits<std::int32_t>();
  RC_ASSERT(to_code(from_code<double>(code)) == code);
  RC_ASSERT(to_code(from_code<Long>(code)) == code);
}

RC_GTEST_PROP(CodeProperty, RoundTripInFloatKeepsTwentyFourBits, ()) {
  const auto code = any_bits<std::int32_t>();
  const std::int64_t difference = std::int64_t{to_code(from_code<float>(code))} - code;
  RC_ASSERT(std::abs(difference) <= 64);
}

RC_GTEST_PROP(CodeProperty, ToCodeIsTheNearest, ()) {
  const double x = any_between(-1.0, 0.999999999);
  const double wanted = std::floor(x * 0x1p31 + 0.5);
  RC_ASSERT(static_cast<double>(to_code(x)) == wanted);
}

RC_GTEST_PROP(FloatProperty, SineAndCosineLieOnTheCircle, ()) {
  const double x = any_between(-1e6, 1e6);
  const double sine = sin(x);
  const double cosine = cos(x);
  RC_ASSERT(std::abs(sine * sine + cosine * cosine - 1.0) <= 1e-15);
}

RC_GTEST_PROP(FloatProperty, SineIsOddAndCosineEven, ()) {
  const double x = any_between(-1e6, 1e6);
  RC_ASSERT(sin(-x) == -sin(x));
  RC_ASSERT(cos(-x) == cos(x));
}

RC_GTEST_PROP(FloatProperty, SquareRootExponentialAndArcsineGrow, ()) {
  const double x = any_between(-1.0, 1.0);
  const double y = any_between(-1.0, 1.0);
  const double low = std::min(x, y);
  const double high = std::max(x, y);
  RC_PRE(high - low > 1e-14);
  RC_ASSERT(exp(low) < exp(high));
  RC_ASSERT(expm1(low) < expm1(high));
  RC_ASSERT(asin(low) < asin(high));
  RC_ASSERT(acos(low) > acos(high));
  RC_ASSERT(sqrt(low + 1.0) <= sqrt(high + 1.0));
}

RC_GTEST_PROP(FloatProperty, LogarithmUndoesPowerOfTwo, ()) {
  const double x = any_between(-1000.0, 1000.0);
  RC_ASSERT(std::abs(log2(exp2(x)) - x) <= 1e-15 + 2.3e-16 * std::abs(x));
}

RC_GTEST_PROP(FloatProperty, SplitAndScaleAreInverse, ()) {
  const auto bits = any_bits<std::uint64_t>();
  const double x = from_bits<double>(bits >> 1);
  RC_PRE(std::isfinite(x) && x > 0.0);
  const auto parts = split(x);
  RC_ASSERT(parts.mantissa >= 0.5 && parts.mantissa < 1.0);
  RC_ASSERT(scale_by_power_of_two(parts.mantissa, parts.exponent) == x);
}

}  // namespace
}  // namespace sonoglide::numeric::properties_test
