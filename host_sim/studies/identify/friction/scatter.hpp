/// Scatter from reading to reading, and misfit that neighbouring readings share.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "host_sim/studies/identify/friction/readings.hpp"

namespace sonoglide::identify::friction {

/// What residuals may be made of: white scatter, and a smooth misfit that is a Gaussian process over
/// the velocity ratio. Readings at one velocity ratio have the same misfit. Distances are counted in
/// different velocity ratios, so that no scale of velocity matters.
class Scatter {
 public:
  /// @param share   variance of the misfit over that of the scatter [-]; 0: none
  /// @param length  distance over which the misfit persists, as a part of all: its correlation at
  ///                distance d is exp(-d²/2 length²)
  /// @param prior   probability before the data
  Scatter(const Readings& readings, double share, double length, double prior);

  double share() const { return share_; }
  double prior() const { return prior_; }
  double log_determinant() const { return log_determinant_; }

  /// Makes columns of residuals white, with the variance of the scatter.
  void whiten(Eigen::Ref<Eigen::MatrixXd> columns) const;

 private:
  double share_;
  double prior_;
  double log_determinant_ = 0.0;
  Eigen::MatrixXd factor_;  ///< Cholesky factor of the covariance; empty where there is no misfit
};

/// No misfit, first, and misfits of several sizes and lengths, unless there are fewer than 6
/// different velocity ratios.
std::vector<Scatter> scatters(const Readings& readings);

/// Probabilities of the scatters after residuals, parameters and the scatter's variance integrated
/// out: the restricted likelihood of the model linearised by its Jacobian.
std::vector<double> probabilities(const std::vector<Scatter>& scatters,
                                  const Eigen::VectorXd& residuals,
                                  const Eigen::MatrixXd& jacobian);

}  // namespace sonoglide::identify::friction
