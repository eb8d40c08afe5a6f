/// A law against the readings as a problem of least squares.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "host_sim/studies/identify/friction/candidate.hpp"
#include "host_sim/studies/identify/friction/readings.hpp"
#include "host_sim/studies/identify/least_squares.hpp"

namespace sonoglide::identify::friction {

// Scatter from reading to reading, and misfit that neighbouring readings share.

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

/// Parameters are logarithms: of the shape parameters, which keep to their ranges, and of the
/// friction limit where the readings are forces.
class LawProblem {
 public:
  /// @param readings, candidate  outlive this
  LawProblem(const Readings& readings, const Candidate& candidate);

  Eigen::Index readings() const { return static_cast<Eigen::Index>(readings_.rows.size()); }
  Eigen::Index parameters() const { return static_cast<Eigen::Index>(ranges_.size()); }

  struct Range {
    double least;
    double most;
  };
  /// Of the logarithm.
  const Range& range(Eigen::Index parameter) const {
    return ranges_[static_cast<std::size_t>(parameter)];
  }

  /// Friction that the law gives for a reading, of its kind.
  double friction(const Reading& row, const Eigen::VectorXd& logs) const;
  Eigen::VectorXd friction(const Eigen::VectorXd& logs) const;

  /// Measured less given, weighted by the standard errors if there are any: the mean weight is 1.
  Eigen::VectorXd residuals(const Eigen::VectorXd& logs) const;
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& logs) const;

  /// Variance that the stated standard errors give residuals(); 0 without any.
  double stated_variance() const { return stated_variance_; }
  /// Least variance of residuals(): that of the values' last digit, and what the fits are exact to.
  double least_variance() const { return least_variance_; }
  /// Whether the readings are of at least as many different velocities as there are parameters.
  bool is_determined() const {
    return static_cast<Eigen::Index>(readings_.distinct()) >= parameters();
  }

  struct Solution {
    Eigen::VectorXd logs;
    double sum_of_squares = 0.0;  ///< of whitened residuals
  };

  /// For white scatter: the best of grids, made better. The edges on which the law is a simpler one
  /// are in them, so that it fits no worse.
  Solution solve() const;
  /// Under a scatter, from a start; one parameter may be held. Where the friction limit is free it
  /// is no part of the search: it is linear, and each shape has its best one.
  Solution solve(const Scatter& scatter, const Eigen::VectorXd& start,
                 std::optional<Eigen::Index> held = {}) const;

 private:
  /// Residuals at some parameters, and those parameters with the friction limit that was found.
  struct Residuals {
    Eigen::VectorXd whitened;
    Eigen::VectorXd logs;
  };

  Residuals whitened(const Scatter& scatter, Eigen::VectorXd logs, bool limit_is_free) const;
  Eigen::VectorXd shape_friction(const Eigen::VectorXd& logs) const;
  double shape_friction(const Reading& row, const Eigen::VectorXd& logs) const;
  std::vector<Eigen::VectorXd> grid(int first, int others) const;
  Solution best_from(const std::vector<Eigen::VectorXd>& points, std::size_t most_tries) const;

  const Readings& readings_;
  const Candidate& candidate_;
  std::vector<Range> ranges_;
  Eigen::VectorXd measured_;
  Eigen::VectorXd weights_;
  double stated_variance_ = 0.0;
  double least_variance_ = 0.0;
  Scatter white_;
};

}  // namespace sonoglide::identify::friction
