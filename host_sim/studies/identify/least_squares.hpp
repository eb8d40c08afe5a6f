/// Nonlinear least squares, and what its minimum is worth.
#pragma once

#include <Eigen/Core>

#include <functional>

namespace sonoglide::identify {

/// A sum of squares over the residuals r(p).
///
/// The parameters should be such that a change of each by 1 means much: logarithms of what is
/// positive.
struct LeastSquares {
  Eigen::Index residuals;
  Eigen::Index parameters;
  /// Fills the residuals at p and, where it is not null, the Jacobian dr/dp.
  std::function<void(const Eigen::VectorXd& p, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian)>
      evaluate;
};

struct LeastSquaresFit {
  Eigen::VectorXd parameters;
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
  double sum_of_squares = 0.0;
  bool converged = false;  ///< false: it ran into values that are not finite, or out of evaluations
};

/// Levenberg–Marquardt (Eigen's, after MINPACK's lmder: scaled by the columns of the Jacobian).
///
/// Converged: the step or the decrease of the sum is below the accuracy, relatively, or the residuals are
/// perpendicular to the columns.
/// Source: Moré, "The Levenberg-Marquardt algorithm: implementation and theory" (1978).
LeastSquaresFit minimise(const LeastSquares& problem, const Eigen::VectorXd& start,
                         double accuracy = 1e-12, int most_evaluations = 400);

/// (JᵀJ)⁻¹ by a singular value decomposition of the Jacobian with its columns scaled to length 1. A
/// direction that the residuals do not feel, below 1e-12 of the largest, gets an infinite variance.
/// @return the covariance of the parameters for residuals of variance 1
Eigen::MatrixXd inverse_normal_matrix(const Eigen::MatrixXd& jacobian);

/// Correlations of a covariance; not a number where a variance is not finite.
Eigen::MatrixXd correlations(const Eigen::MatrixXd& covariance);

/// Akaike's criterion corrected for small samples, for Gaussian residuals of unknown variance:
/// n ln(S/n) + 2 k + 2 k (k + 1)/(n − k − 1), k = parameters + 1. Infinite where n − k − 1 <= 0.
/// Source: Hurvich and Tsai, Biometrika 76 (1989).
double corrected_akaike(double sum_of_squares, Eigen::Index residuals, Eigen::Index parameters);

}  // namespace sonoglide::identify
