/// The quick roots of step-size control against those of the library.

#include "firmware/numeric/quick_root.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

namespace sonoglide::numeric::quick_root_test {
namespace {

/// A power of two below `limit` in modulus, times 1 to 2.
template <class Float>
Float positive(int limit) {
  const auto fraction = static_cast<Float>(*rc::gen::inRange(0, 1 << 20)) / Float(1 << 20);
  return std::ldexp(Float(1) + fraction, *rc::gen::inRange(-limit, limit));
}

template <int Degree, class Float>
void expect_root_of_quotient(int limit) {
  const auto a = positive<Float>(limit);
  const auto b = positive<Float>(limit);
  const double logarithm = std::log2(static_cast<double>(a)) - std::log2(static_cast<double>(b));
  const double near = static_cast<double>(quick_root_of_quotient<Degree>(a, b));
  RC_ASSERT(std::abs(near / std::exp2(logarithm / Degree) - 1.0) < 0.08);
}

RC_GTEST_PROP(StepSize, RootOfAQuotientIsNear, ()) {
  expect_root_of_quotient<4, double>(1022);
  expect_root_of_quotient<9, double>(1022);
  expect_root_of_quotient<13, double>(1022);
  expect_root_of_quotient<25, double>(1022);
  expect_root_of_quotient<4, float>(126);
  expect_root_of_quotient<13, float>(126);
}

RC_GTEST_PROP(StepSize, RootIsNear, ()) {
  const auto x = positive<double>(1022);
  RC_ASSERT(std::abs(quick_root<9>(x) / std::pow(x, 1.0 / 9.0) - 1.0) < 0.07);
  RC_ASSERT(std::abs(quick_root<17>(x) / std::pow(x, 1.0 / 17.0) - 1.0) < 0.07);
}

TEST(StepSize, WithoutATermTheRootIsLargeAndFinite) {
  constexpr double smallest = std::numeric_limits<double>::min();
  const double large = quick_root_of_quotient<9>(1e-8, 0.0);
  EXPECT_GT(large, 0.9 * quick_root_of_quotient<9>(1e-8, smallest));
  EXPECT_LE(large, std::numeric_limits<double>::max());
}

}  // namespace
}  // namespace sonoglide::numeric::quick_root_test
