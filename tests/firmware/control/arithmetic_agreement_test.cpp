/// float32, Q31 and Q15 stay beside float64, each in a closed loop of its own, over a long run.
///
/// Bounds on the drive amplitude, four times what was seen: an integrating loop does not let
/// roundings add up.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scalars.hpp"
#include "scripted_run.hpp"

namespace sonoglide::control::arithmetic_agreement_test {
namespace {

constexpr int periods = 5000;

template <class PartsT>
std::vector<double> amplitudes(std::uint32_t seed) {
  std::vector<double> result;
  scripted_run<PartsT>(seed, periods, [&](int /*period*/, const ClosedLoop<PartsT>& loop) {
    result.push_back(loop.amplitude());
  });
  return result;
}

template <template <class> class PartsOf, class Scalar>
double largest_difference() {
  double largest = 0.0;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const auto exact = amplitudes<PartsOf<double>>(seed);
    const auto rounded = amplitudes<PartsOf<Scalar>>(seed);
    for (std::size_t i = 0; i < exact.size(); ++i) {
      largest = std::max(largest, std::abs(exact[i] - rounded[i]));
    }
  }
  return largest;
}

TEST(ArithmeticAgreement, Float32StaysBesideFloat64) {
  EXPECT_LT((largest_difference<ShapedParts, float>()), 1e-5);
  EXPECT_LT((largest_difference<FullParts, float>()), 1e-5);
}

TEST(ArithmeticAgreement, Q31StaysBesideFloat64) {
  EXPECT_LT((largest_difference<ShapedParts, Trapped>()), 5e-7);
  EXPECT_LT((largest_difference<FullParts, Trapped>()), 5e-7);
}

// Its coarser speed meets the speed floor a period earlier or later, and for that period one holds
// what the other follows; everywhere else they are ten times closer.
TEST(ArithmeticAgreement, Q15StaysBesideFloat64) {
  EXPECT_LT((largest_difference<ShapedParts, ShortTrapped>()), 0.1);
  EXPECT_LT((largest_difference<FullParts, ShortTrapped>()), 0.05);
}

}  // namespace
}  // namespace sonoglide::control::arithmetic_agreement_test
