/// The quick search for a reversal finds what the patient one finds.

#include "firmware/plant/taylor/first_reversal.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <cmath>
#include <cstddef>

#include "firmware/numeric/first_root.hpp"

namespace sonoglide::plant::first_reversal_test {
namespace {

constexpr std::size_t count = 13;
using Coefficients = std::array<double, count>;

double value(const Coefficients& p, double x) {
  double sum = 0.0;
  for (std::size_t n = count; n-- > 0;) {
    sum = sum * x + p[n];
  }
  return sum;
}

/// Coefficients that fall like those of a vibration over `radians`, positive at first behind a zero
/// of the given order.
Coefficients random_motion(std::size_t zero_order, double radians) {
  Coefficients p{};
  double scale = 1.0;
  for (std::size_t n = 0; n < count; ++n) {
    p[n] = n < zero_order ? 0.0 : scale * *rc::gen::inRange(-1000000, 1000001) * 1e-6;
    scale *= radians / static_cast<double>(n + 1);
  }
  p[zero_order] = std::abs(p[zero_order]) + 1e-3;
  return p;
}

/// What the search met, of the motions it was given.
struct Met {
  int reversals = 0;
  int none = 0;
};

void is_that_of_the_patient_search(Met& met) {
  const auto zero_order = static_cast<std::size_t>(*rc::gen::inRange(0, 3));
  const double radians = *rc::gen::inRange(1, 300) * 0.01;
  const double direction = *rc::gen::element(1.0, -1.0);
  const double end = *rc::gen::inRange(1, 101) * 0.01;
  Coefficients p = random_motion(zero_order, radians);
  Coefficients quotient{};
  for (std::size_t n = zero_order; n < count; ++n) {
    quotient[n - zero_order] = p[n];
  }
  for (double& coefficient : p) {
    coefficient *= direction;
  }
  const double patient = numeric::first_root(quotient, end);
  const double quick = first_reversal(p, direction, zero_order, end);
  // Next to a double zero both may stop within rounding of it, or pass.
  const double slope =
      std::abs(value(quotient, patient + 1e-6) - value(quotient, patient - 1e-6)) / 2e-6;
  const bool told = patient < end ? slope > 1e-4 : std::abs(value(quotient, end)) > 1e-9;
  if (!told) {
    return;
  }
  RC_ASSERT(std::abs(quick - patient) <= 1e-9);
  ++(patient < end ? met.reversals : met.none);
}

TEST(FirstReversal, IsThatOfThePatientSearch) {
  Met met;
  // One motion in some fifteen reverses.
  EXPECT_TRUE(rc::check([&met] {
    for (int motion = 0; motion < 20; ++motion) {
      is_that_of_the_patient_search(met);
    }
  }));
  EXPECT_GE(met.reversals, 40);
  EXPECT_GE(met.none, 400);
}

void certifies_only_what_is_so(int& certified) {
  const auto zero_order = static_cast<std::size_t>(*rc::gen::inRange(0, 3));
  const double radians = *rc::gen::inRange(1, 300) * 0.01;
  const double end = *rc::gen::inRange(1, 101) * 0.01;
  const Coefficients p = random_motion(zero_order, radians);
  if (certainly_keeps_sign(p, 1.0, zero_order, end, value(p, end))) {
    ++certified;
    for (int i = 1; i <= 1000; ++i) {
      RC_ASSERT(value(p, end * i * 1e-3) > 0.0);
    }
  }
}

TEST(FirstReversal, NothingIsCertifiedThatIsNotSo) {
  int certified = 0;
  EXPECT_TRUE(rc::check([&certified] { certifies_only_what_is_so(certified); }));
  EXPECT_GE(certified, 10);
}

/// A slow fall that all but turns before it crosses: the first guess is far off, and the step from
/// it happens to be short.
TEST(FirstReversal, AFlatFallIsFollowedToItsEnd) {
  for (const double flat : {1e-1, 1e-2, 1e-3, 1e-4}) {
    // (0.7 - x) ((x - 0.65)^2 + flat^2) and its multiples stay positive before 0.7.
    const double a = 0.65 * 0.65 + flat * flat;
    const Coefficients p = {0.7 * a, -a - 0.7 * 1.3, 0.7 + 1.3, -1.0};
    const double rounding = 4e-15;
    const double slope = 0.05 * 0.05 + flat * flat;
    EXPECT_NEAR(first_reversal(p, 1.0, 0, 1.0), 0.7, rounding / slope) << flat;
  }
}

TEST(FirstReversal, SinglePrecisionReachesItsOwnEnd) {
  const std::array<float, 9> p = {0.4F, 0.3F, -2.0F, 0.1F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F};
  const float root = first_reversal(p, 1.0F, 0, 1.0F);
  EXPECT_NEAR(0.4F + root * (0.3F + root * (-2.0F + root * 0.1F)), 0.0F, 2e-7F);
}

}  // namespace
}  // namespace sonoglide::plant::first_reversal_test
