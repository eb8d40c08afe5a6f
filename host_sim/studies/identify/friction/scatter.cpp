#include "host_sim/studies/identify/friction/law_problem.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace sonoglide::identify::friction {
namespace {

/// Place of each reading among the different velocity ratios, from 0.
std::vector<int> places_of(const Readings& readings) {
  std::vector<int> places;
  for (std::size_t i = 0; i < readings.rows.size(); ++i) {
    const bool same =
        i > 0 && readings.rows[i].velocity_ratio() == readings.rows[i - 1].velocity_ratio();
    places.push_back(i == 0 ? 0 : places.back() + (same ? 0 : 1));
  }
  return places;
}

}  // namespace

Scatter::Scatter(const Readings& readings, double share, double length, double prior)
    : share_(share), prior_(prior) {
  if (share == 0.0) {
    return;
  }
  const std::vector<int> places = places_of(readings);
  const double unit = length * (places.back() + 1);
  const auto n = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const double distance =
          (places[static_cast<std::size_t>(i)] - places[static_cast<std::size_t>(j)]) / unit;
      covariance(i, j) += share * std::exp(-0.5 * distance * distance);
    }
  }
  factor_ = covariance.llt().matrixL();
  log_determinant_ = 2.0 * factor_.diagonal().array().log().sum();
}

// By value: a reference to the caller's matrix, as Eigen has it.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
void Scatter::whiten(Eigen::Ref<Eigen::MatrixXd> columns) const {
  if (share_ > 0.0) {
    factor_.triangularView<Eigen::Lower>().solveInPlace(columns);
  }
}

std::vector<Scatter> scatters(const Readings& readings) {
  constexpr double none = 0.5;
  constexpr double shares[] = {1.0, 10.0, 100.0};
  constexpr double lengths[] = {0.08, 0.2};
  constexpr double prior = (1.0 - none) / 6.0;
  constexpr int least_places = 6;
  std::vector<Scatter> all = {{readings, 0.0, 1.0, none}};
  if (places_of(readings).back() + 1 >= least_places) {
    for (const double share : shares) {
      for (const double length : lengths) {
        all.emplace_back(readings, share, length, prior);
      }
    }
  }
  return all;
}

std::vector<double> probabilities(const std::vector<Scatter>& scatters,
                                  const Eigen::VectorXd& residuals,
                                  const Eigen::MatrixXd& jacobian) {
  const Eigen::Index n = residuals.size();
  const Eigen::Index p = jacobian.cols();
  std::vector<double> logs;
  for (const Scatter& each : scatters) {
    Eigen::MatrixXd columns(n, p + 1);
    columns << jacobian, residuals;
    each.whiten(columns);
    double sum = columns.col(p).squaredNorm();
    double log_normal = 0.0;
    if (p > 0) {
      const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns.leftCols(p));
      const Eigen::VectorXd turned = qr.householderQ().transpose() * columns.col(p);
      sum = turned.tail(n - qr.rank()).squaredNorm();
      log_normal = 2.0 * qr.matrixQR().diagonal().head(qr.rank()).array().abs().log().sum();
    }
    logs.push_back(std::log(each.prior()) - 0.5 * (each.log_determinant() + log_normal) -
                   0.5 * static_cast<double>(n - p) * std::log(std::max(sum, 1e-300)));
  }
  const double most = *std::max_element(logs.begin(), logs.end());
  double total = 0.0;
  for (double& each : logs) {
    each = std::exp(each - most);
    total += each;
  }
  for (double& each : logs) {
    each /= total;
  }
  return logs;
}

}  // namespace sonoglide::identify::friction
