#include "host_sim/studies/identify/impedance/circuit_fit.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

namespace sonoglide::identify::impedance {

Noise sizes(const Noise& noise) {
  return {noise.exponent, noise.phase_scale};
}

bool is_rounding(const Linearisation& at) {
  return at.residuals.squaredNorm() <=
         rounding * rounding * static_cast<double>(at.residuals.size());
}

namespace {

/// Divides columns by the size of their readings, and by the error of each frequency.
/// @return the logarithm of the covariance's determinant
double scale(const Noise& noise, const Linearisation& at, Eigen::Ref<Eigen::MatrixXd>& columns) {
  const Eigen::Index readings = at.log_magnitude.size();
  const bool has_phase = columns.rows() > readings;
  const Eigen::ArrayXd size = ((1.0 - noise.exponent) * at.log_magnitude.array()).exp();
  double log_determinant =
      (has_phase ? 4.0 : 2.0) * (noise.exponent - 1.0) * at.log_magnitude.sum();
  columns.topRows(readings).array().colwise() *= size;
  if (has_phase) {
    columns.bottomRows(readings).array().colwise() *= size / noise.phase_scale;
    log_determinant += 2.0 * static_cast<double>(readings) * std::log(noise.phase_scale);
  }
  if (noise.jitter == 0.0) {
    return log_determinant;
  }
  const Eigen::ArrayXd along_magnitude = at.slope.real().array() * size;
  const Eigen::ArrayXd along_phase =
      (has_phase ? 1.0 / noise.phase_scale : 0.0) * at.slope.imag().array() * size;
  const Eigen::ArrayXd square = (along_magnitude.square() + along_phase.square()).max(1e-300);
  const Eigen::ArrayXd larger = 1.0 + noise.jitter * noise.jitter * square;
  const Eigen::ArrayXd share = (1.0 - larger.rsqrt()) / square;
  for (Eigen::Index column = 0; column < columns.cols(); ++column) {
    auto magnitude = columns.col(column).head(readings).array();
    auto phase = columns.col(column).tail(readings).array();  // the same where there is none
    const Eigen::ArrayXd along = share * (along_magnitude * magnitude + along_phase * phase);
    magnitude -= along_magnitude * along;
    if (has_phase) {
      phase -= along_phase * along;
    }
  }
  return log_determinant + larger.log().sum();
}

/// Takes from each reading what those before it tell of it.
double decorrelate(const Noise& noise, Eigen::Index readings,
                   Eigen::Ref<Eigen::MatrixXd>& columns) {
  const double own_share = 1.0 - noise.correlated_share;
  const double forgetting = noise.memory * noise.memory;
  double variance = noise.correlated_share;  // of the process, before the reading
  double log_determinant = 0.0;
  Eigen::ArrayXd gain(readings);
  Eigen::ArrayXd size(readings);
  for (Eigen::Index i = 0; i < readings; ++i) {
    const double seen = variance + own_share;
    gain(i) = noise.memory * variance / seen;
    size(i) = 1.0 / std::sqrt(seen);
    log_determinant += std::log(seen);
    variance =
        forgetting * variance * own_share / seen + (1.0 - forgetting) * noise.correlated_share;
  }
  for (Eigen::Index column = 0; column < columns.cols(); ++column) {
    for (Eigen::Index begin = 0; begin < columns.rows(); begin += readings) {
      double state = 0.0;
      for (Eigen::Index i = 0; i < readings; ++i) {
        const double innovation = columns(begin + i, column) - state;
        columns(begin + i, column) = innovation * size(i);
        state = noise.memory * state + gain(i) * innovation;
      }
    }
  }
  const Eigen::Index values_per_reading = columns.rows() / readings;
  return log_determinant * static_cast<double>(values_per_reading);
}

}  // namespace

double whiten(const Noise& noise, const Linearisation& at, Eigen::Ref<Eigen::MatrixXd> columns) {
  const double log_determinant = scale(noise, at, columns);
  return noise.correlated_share > 0.0
             ? log_determinant + decorrelate(noise, at.log_magnitude.size(), columns)
             : log_determinant;
}

Solution solve(const Linearisation& at, const Noise& noise) {
  const Eigen::Index p = at.jacobian.cols();
  Eigen::MatrixXd columns(at.residuals.size(), p + 1);
  columns << at.jacobian, at.residuals;
  double deviance = whiten(noise, at, columns);
  const Eigen::VectorXd scale =
      columns.leftCols(p).colwise().norm().cwiseMax(1e-300).cwiseInverse();
  columns.leftCols(p) *= scale.asDiagonal();
  const Eigen::HouseholderQR<Eigen::MatrixXd> solver(columns);
  const Eigen::MatrixXd r = solver.matrixQR().topRows(p + 1).triangularView<Eigen::Upper>();
  const auto freedom = static_cast<double>(at.residuals.size() - p);
  const double left = r(p, p) * r(p, p);
  const double variance = std::max(left / freedom, rounding * rounding);
  deviance += 2.0 * (r.diagonal().head(p).cwiseAbs().array() / scale.array()).log().sum() +
              freedom * std::log(left);
  constexpr double beforehand = 10.0;
  const Eigen::VectorXd weak = (std::sqrt(variance) / beforehand) * scale.tail(3 * at.modes);
  Eigen::MatrixXd normal = r.topLeftCorner(p, p).transpose() * r.topLeftCorner(p, p);
  normal.diagonal().tail(3 * at.modes) += weak.cwiseAbs2();
  const Eigen::MatrixXd inverse = scale.asDiagonal() *
                                  normal.ldlt().solve(Eigen::MatrixXd::Identity(p, p)) *
                                  scale.asDiagonal();
  const Eigen::VectorXd right =
      scale.cwiseInverse().asDiagonal() * (r.topLeftCorner(p, p).transpose() * r.col(p).head(p));
  return {-inverse * right, variance * inverse, deviance};
}

namespace {

/// What the noise may be, of given sizes, and its probability before the readings.
struct Supposition {
  Noise noise;
  double prior;
};

std::vector<Supposition> suppositions(const Noise& noise) {
  constexpr double jitters[] = {0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 50.0, 200.0};
  constexpr double memories[] = {0.2, 0.5, 0.7, 0.8, 0.88, 0.93, 0.96, 0.98};
  constexpr double shares[] = {0.05, 0.15, 0.3, 0.5, 0.7, 0.85, 0.95, 0.995};
  constexpr double of_jitter = 0.15 / std::size(jitters);
  constexpr double of_correlation = 0.4 / (std::size(memories) * std::size(shares));
  const double e = noise.exponent;
  const double scale = noise.phase_scale;
  std::vector<Supposition> all = {{{e, scale}, 0.45}};
  for (const double jitter : jitters) {
    all.push_back({{e, scale, jitter}, of_jitter});
  }
  for (const double memory : memories) {
    for (const double share : shares) {
      all.push_back({{e, scale, 0.0, share, memory}, of_correlation});
    }
  }
  return all;
}

/// The likeliest, with prices for what is not white and for phases that are not as magnitudes: so high that it is
/// certain, since sizes that follow a few quiet readings make the intervals too short.
Noise likeliest(const Linearisation& at, const std::vector<Noise>& all) {
  constexpr double price = 4.0;
  std::vector<double> deviances;
  for (const Noise& each : all) {
    const bool is_white = each.jitter == 0.0 && each.correlated_share == 0.0;
    deviances.push_back(solve(at, each).deviance + (is_white ? 0.0 : price) +
                        (each.phase_scale == 1.0 ? 0.0 : price));
  }
  return all[static_cast<std::size_t>(std::min_element(deviances.begin(), deviances.end()) -
                                      deviances.begin())];
}

std::vector<Noise> with_exponents(const Noise& noise) {
  std::vector<Noise> all(3, noise);
  all[0].exponent = 1.0;
  all[1].exponent = 0.0;
  all[2].exponent = 2.0;
  return all;
}

}  // namespace

Noise estimate_noise(const Linearisation& at, Correlation correlation) {
  if (is_rounding(at)) {
    return {};
  }
  Noise noise = likeliest(at, with_exponents({}));
  if (correlation == Correlation::estimated) {
    std::vector<Noise> all;
    for (const Supposition& each : suppositions(noise)) {
      all.push_back(each.noise);
    }
    noise = likeliest(at, with_exponents(likeliest(at, all)));
  }
  const Eigen::Index readings = at.log_magnitude.size();
  if (at.residuals.size() == readings) {
    return noise;
  }
  Eigen::VectorXd residuals = at.residuals;
  whiten(noise, at, residuals);
  Noise other = noise;
  other.phase_scale = residuals.tail(readings).norm() / residuals.head(readings).norm();
  return likeliest(at, {noise, other});
}

Eigen::MatrixXd average_over_noise(const Linearisation& at, const Noise& noise) {
  if (is_rounding(at)) {
    return solve(at, noise).covariance;
  }
  double sum = 0.0;
  double least = std::numeric_limits<double>::infinity();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(at.jacobian.cols(), at.jacobian.cols());
  for (const Supposition& each : suppositions(noise)) {
    const Solution solution = solve(at, each.noise);
    if (solution.deviance < least) {  // Weights are relative to the likeliest so far.
      const double smaller = std::exp(0.5 * (solution.deviance - least));
      sum *= smaller;
      covariance *= smaller;
      least = solution.deviance;
    }
    const double weight = each.prior * std::exp(0.5 * (least - solution.deviance));
    sum += weight;
    covariance += weight * (solution.covariance + solution.step * solution.step.transpose());
  }
  return covariance / sum;
}

}  // namespace sonoglide::identify::impedance
