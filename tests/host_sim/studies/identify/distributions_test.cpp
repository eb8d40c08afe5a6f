#include "host_sim/studies/identify/distributions.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace sonoglide::identify {
namespace {

/// Student's table.
TEST(Distributions, HaveTheQuantilesOfStudent) {
  EXPECT_NEAR(student_t_95(1.0), 12.706, 5e-4);
  EXPECT_NEAR(student_t_95(10.0), 2.228, 5e-4);
  EXPECT_NEAR(student_t_95(1e6), 1.96, 5e-4);
}

/// Of one degree of freedom it is Cauchy's.
TEST(Distributions, AStudentOfOneDegreeIsCauchys) {
  for (const double t : {-40.0, -1.0, 0.0, 0.3, 7.0}) {
    const double probability = 0.5 + std::atan(t) / std::acos(-1.0);
    EXPECT_NEAR(student_t_probability(1.0, t), probability, 1e-14);
    EXPECT_NEAR(student_t_quantile(1.0, probability), t, 1e-11);
  }
}

/// Of two degrees of freedom it is an exponential one.
TEST(Distributions, AChiSquaredOfTwoDegreesIsExponential) {
  for (const double value : {0.0, 0.5, 3.0, 60.0}) {
    EXPECT_NEAR(chi_squared_above(2.0, value), std::exp(-0.5 * value), 1e-14);
  }
}

}  // namespace
}  // namespace sonoglide::identify
