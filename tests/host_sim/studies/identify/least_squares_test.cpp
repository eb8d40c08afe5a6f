#include "host_sim/studies/identify/least_squares.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sonoglide::identify {
namespace {

/// NIST StRD Misra1a: y = b1 (1 − exp(−b2 x)), certified values of the National Institute of
/// Standards and Technology.
TEST(LeastSquares, HasTheCertifiedValuesOfMisra1a) {
  const std::vector<double> x = {77.6,  114.9, 141.1, 190.8, 239.9, 289.0, 332.8,
                                 378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0};
  const std::vector<double> y = {10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02,
                                 44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78};
  const LeastSquares problem{
      14, 2, [&](const Eigen::VectorXd& b, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
        for (Eigen::Index i = 0; i < 14; ++i) {
          const double at = x[static_cast<std::size_t>(i)];
          const double decay = std::exp(-b(1) * at);
          r(i) = b(0) * (1.0 - decay) - y[static_cast<std::size_t>(i)];
          if (jacobian != nullptr) {
            jacobian->row(i) << 1.0 - decay, b(0) * at * decay;
          }
        }
      }};
  const LeastSquaresFit fit = minimise(problem, Eigen::Vector2d(500.0, 0.0001));
  ASSERT_TRUE(fit.converged);
  EXPECT_NEAR(fit.parameters(0), 2.3894212918E+02, 1e-6);
  EXPECT_NEAR(fit.parameters(1), 5.5015643181E-04, 1e-12);
  EXPECT_NEAR(fit.sum_of_squares, 1.2455138894E-01, 1e-10);
  const Eigen::MatrixXd covariance =
      fit.sum_of_squares / 12.0 * inverse_normal_matrix(fit.jacobian);
  EXPECT_NEAR(std::sqrt(covariance(0, 0)), 2.7070075241E+00, 1e-6);
  EXPECT_NEAR(std::sqrt(covariance(1, 1)), 7.2668688436E-06, 1e-11);
}

TEST(LeastSquares, ADirectionThatNothingFeelsHasNoBound) {
  Eigen::MatrixXd jacobian(4, 3);
  jacobian << 1, 1, 0, 2, 2, 1, 3, 3, 0, 4, 4, 1;
  const Eigen::MatrixXd covariance = inverse_normal_matrix(jacobian);
  EXPECT_TRUE(std::isinf(covariance(0, 0)));
  EXPECT_TRUE(std::isinf(covariance(1, 1)));
  EXPECT_TRUE(std::isfinite(covariance(2, 2)));
}

}  // namespace
}  // namespace sonoglide::identify
