/// Against Horner's rule, lane by lane, on whole numbers: every sum is exact.
#include "firmware/numeric/lane_polynomial.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>

namespace sonoglide::numeric::lane_polynomial_test {
namespace {

template <class Float>
class LanePolynomials : public testing::Test {
 protected:
  /// Of coefficients without a pattern, at other numbers in each lane.
  template <std::size_t Degree>
  static void expect_value_and_rate() {
    constexpr std::array<int, 8> numbers{3, -1, 4, 1, -5, 9, 2, -6};
    constexpr std::array<int, 4> places{-2, 1, 3, 0};
    LanePolynomial<Float, Degree> p{};
    for (std::size_t n = 0; n <= Degree; ++n) {
      p[n] = broadcast(static_cast<Float>(numbers[n]));
    }
    Lanes<Float> x{};
    for (std::size_t lane = 0; lane < lane_count<Float>; ++lane) {
      x[lane] = static_cast<Float>(places[lane % 4]);
    }
    const Lanes<Float> value = value_at(p, x);
    const Lanes<Float> rate = rate_at<Float>(p, x);
    for (std::size_t lane = 0; lane < lane_count<Float>; ++lane) {
      const int place = places[lane % 4];
      int expected_value = 0;
      int expected_rate = 0;
      for (std::size_t n = Degree + 1; n-- > 0;) {
        expected_rate = expected_rate * place + expected_value;
        expected_value = expected_value * place + numbers[n];
      }
      EXPECT_EQ(value[lane], static_cast<Float>(expected_value)) << Degree << ' ' << place;
      EXPECT_EQ(rate[lane], static_cast<Float>(expected_rate)) << Degree << ' ' << place;
    }
  }
};
using Floats = testing::Types<double, float>;
TYPED_TEST_SUITE(LanePolynomials, Floats);

TYPED_TEST(LanePolynomials, OfEveryDegreeHaveTheirValueAndRate) {
  this->template expect_value_and_rate<3>();
  this->template expect_value_and_rate<4>();
  this->template expect_value_and_rate<5>();
  this->template expect_value_and_rate<6>();
  this->template expect_value_and_rate<7>();
}

}  // namespace
}  // namespace sonoglide::numeric::lane_polynomial_test
