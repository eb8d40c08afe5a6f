#include "host_sim/studies/identify/least_squares.hpp"

#include <Eigen/SVD>
#include <unsupported/Eigen/NonLinearOptimization>

#include <cmath>
#include <limits>

namespace sonoglide::identify {
namespace {

/// What Eigen's solver asks for.
struct Functor {
  const LeastSquares& problem;

  int inputs() const { return static_cast<int>(problem.parameters); }
  int values() const { return static_cast<int>(problem.residuals); }

  int operator()(const Eigen::VectorXd& p, Eigen::VectorXd& r) const {
    problem.evaluate(p, r, nullptr);
    return 0;
  }

  int df(const Eigen::VectorXd& p, Eigen::MatrixXd& jacobian) const {
    Eigen::VectorXd r(problem.residuals);
    problem.evaluate(p, r, &jacobian);
    return jacobian.allFinite() ? 0 : -1;
  }
};

}  // namespace

LeastSquaresFit minimise(const LeastSquares& problem, const Eigen::VectorXd& start, double accuracy,
                         int most_evaluations) {
  Functor functor{problem};
  Eigen::LevenbergMarquardt<Functor, double> solver(functor);
  solver.parameters.ftol = accuracy;
  solver.parameters.xtol = accuracy;
  solver.parameters.maxfev = most_evaluations;
  Eigen::VectorXd p = start;
  const Eigen::LevenbergMarquardtSpace::Status status = solver.minimize(p);
  LeastSquaresFit fit{p, Eigen::VectorXd(problem.residuals),
                      Eigen::MatrixXd(problem.residuals, problem.parameters), 0.0, false};
  problem.evaluate(p, fit.residuals, &fit.jacobian);
  fit.sum_of_squares = fit.residuals.squaredNorm();
  fit.converged = status != Eigen::LevenbergMarquardtSpace::UserAsked &&
                  status != Eigen::LevenbergMarquardtSpace::ImproperInputParameters &&
                  status != Eigen::LevenbergMarquardtSpace::TooManyFunctionEvaluation &&
                  p.allFinite() && std::isfinite(fit.sum_of_squares) && fit.jacobian.allFinite();
  return fit;
}

Eigen::MatrixXd inverse_normal_matrix(const Eigen::MatrixXd& jacobian) {
  const Eigen::RowVectorXd lengths = jacobian.colwise().norm();
  const Eigen::RowVectorXd scales =
      lengths.unaryExpr([](double length) { return length > 0.0 ? 1.0 / length : 1.0; });
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian * scales.asDiagonal(), Eigen::ComputeThinV);
  const Eigen::VectorXd& values = svd.singularValues();
  constexpr double least = 1e-12;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(jacobian.cols(), jacobian.cols());
  const Eigen::MatrixXd& v = svd.matrixV();
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (values(i) > least * values(0)) {
      covariance += v.col(i) * v.col(i).transpose() / (values(i) * values(i));
    } else {
      for (Eigen::Index j = 0; j < v.rows(); ++j) {
        if (std::abs(v(j, i)) > 1e-6) {
          covariance(j, j) = std::numeric_limits<double>::infinity();
        }
      }
    }
  }
  return scales.asDiagonal() * covariance * scales.asDiagonal();
}

Eigen::MatrixXd correlations(const Eigen::MatrixXd& covariance) {
  const Eigen::VectorXd inverse = covariance.diagonal().cwiseSqrt().cwiseInverse();
  return inverse.asDiagonal() * covariance * inverse.asDiagonal();
}

double corrected_akaike(double sum_of_squares, Eigen::Index residuals, Eigen::Index parameters) {
  const auto n = static_cast<double>(residuals);
  const double k = static_cast<double>(parameters) + 1.0;
  if (n - k - 1.0 <= 0.0) {
    return std::numeric_limits<double>::infinity();
  }
  return n * std::log(sum_of_squares / n) + 2.0 * k + 2.0 * k * (k + 1.0) / (n - k - 1.0);
}

}  // namespace sonoglide::identify
