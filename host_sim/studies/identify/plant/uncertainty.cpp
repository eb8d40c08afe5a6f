#include "host_sim/studies/identify/plant/uncertainty.hpp"

#include <algorithm>

#include "host_sim/studies/identify/distributions.hpp"

namespace sonoglide::identify::plant {
namespace {

/// An ideal sensor of a scene says nothing of the unit's: no converter of one is finer than this.
constexpr int finest_bits = 16;

/// A loop that has settled reads one code again and again: its rounding is one error of a whole stretch, unless
/// noise of its size stirs it.
Eigen::MatrixXd rounding_covariance(const Eigen::MatrixXd& slopes, const Eigen::MatrixXd& inverse,
                                    const std::vector<Stretch>& stretches,
                                    const Expected& expected) {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(inverse.rows(), inverse.cols());
  if (expected.noise > expected.rounding) {
    return covariance;
  }
  Eigen::Index first = 0;
  for (const Stretch& each : stretches) {
    const auto n = static_cast<Eigen::Index>(each.steps.size());
    const Eigen::VectorXd moved =
        expected.rounding * inverse * slopes.middleRows(first, n).colwise().sum().transpose();
    covariance += moved * moved.transpose();
    first += n;
  }
  return covariance;
}

}  // namespace

Expected expected(const scene::Sensor& sensor) {
  const double quantum = std::ldexp(2.0, -sensor.adc_bits.value_or(finest_bits));
  return {sensor.reading_noise_N() / sensor.force_full_scale_N, quantum / std::sqrt(12.0)};
}

double correlation_factor(const Eigen::VectorXd& residuals) {
  const double variance = residuals.squaredNorm();
  const Eigen::Index n = residuals.size();
  double factor = 1.0;
  for (Eigen::Index lag = 1; variance > 0.0 && lag + 1 < n; lag += 2) {
    const auto at = [&](Eigen::Index k) {
      return residuals.head(n - k).dot(residuals.tail(n - k)) / variance;
    };
    const double pair = at(lag) + at(lag + 1);
    if (pair <= 0.0) {
      break;
    }
    factor += 2.0 * pair;
  }
  return factor;
}

Deviations deviations(const LeastSquaresFit& fit, const Eigen::MatrixXd& slopes,
                      const std::vector<Stretch>& stretches, const Expected& expected) {
  const auto n = static_cast<double>(fit.residuals.size());
  const auto p = static_cast<double>(fit.parameters.size());
  const double factor = correlation_factor(fit.residuals);
  const double seen = fit.sum_of_squares / std::max(n - p, 1.0);
  const Eigen::MatrixXd inverse = inverse_normal_matrix(slopes);
  const double variance = factor * std::max(seen, std::pow(expected.deviation(), 2));
  const Eigen::MatrixXd covariance =
      variance * inverse + rounding_covariance(slopes, inverse, stretches, expected);
  return {covariance.diagonal().cwiseSqrt(), student_t_95(std::max(n / factor - p, 1.0)),
          covariance};
}

}  // namespace sonoglide::identify::plant
