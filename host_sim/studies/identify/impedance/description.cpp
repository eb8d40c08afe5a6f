#include "host_sim/studies/identify/impedance/description.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "host_sim/studies/identify/least_squares.hpp"

namespace sonoglide::identify::impedance {
namespace {

/// Residuals over their size.
Eigen::VectorXd scaled_residuals(const CircuitFit& fit) {
  Eigen::VectorXd scaled = fit.at.residuals;
  whiten(sizes(fit.noise), fit.at, scaled);
  return scaled;
}

/// Standard deviation from reading to reading.
double scatter_of(const Eigen::VectorXd& residuals, Eigen::Index readings) {
  std::vector<double> steps;
  for (Eigen::Index i = 1; i < residuals.size(); ++i) {
    if (i % readings != 0) {
      steps.push_back(std::abs(residuals(i) - residuals(i - 1)));
    }
  }
  constexpr double share = 0.9;
  constexpr double deviations = 1.6449;  // of a Gaussian's |x| at that share
  const auto at =
      steps.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(steps.size() - 1));
  std::nth_element(steps.begin(), at, steps.end());
  return *at / (deviations * std::sqrt(2.0));
}

}  // namespace

double Description::misfit() const {
  return std::sqrt(std::max(residual * residual - scatter * scatter, 0.0));
}

bool Description::fails() const {
  constexpr double many = 2.0;
  constexpr double least = 1e-3;
  return residual > many * scatter && residual > least;
}

Description describe(const CircuitFit& fit) {
  const Eigen::Index readings = fit.at.log_magnitude.size();
  const Eigen::VectorXd scaled = scaled_residuals(fit);
  const auto rows = static_cast<double>(scaled.size());
  const double size = scaled.norm() / std::sqrt(rows);
  const double residual = fit.at.residuals.norm() / std::sqrt(static_cast<double>(readings));
  const double share = size > 0.0 ? std::min(scatter_of(scaled, readings) / size, 1.0) : 1.0;
  return {residual, residual * share};
}

void allow_for_misfit(CircuitFit& fit) {
  const Description description = describe(fit);
  if (!description.fails()) {
    return;
  }
  Eigen::MatrixXd jacobian = fit.at.jacobian;
  whiten(sizes(fit.noise), fit.at, jacobian);
  const double share = std::pow(description.misfit() / description.residual, 2);
  const double along_each =
      share * scaled_residuals(fit).squaredNorm() / static_cast<double>(fit.p.size());
  fit.covariance += along_each * inverse_normal_matrix(jacobian);
}

}  // namespace sonoglide::identify::impedance
