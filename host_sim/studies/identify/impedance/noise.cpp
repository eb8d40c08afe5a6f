#include "host_sim/studies/identify/impedance/noise.hpp"

#include <Eigen/Cholesky>
#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "host_sim/studies/identify/least_squares.hpp"

namespace sonoglide::identify::impedance {

bool is_rounding(const Linearisation& at) {
  return at.residuals.squaredNorm() <=
         rounding * rounding * static_cast<double>(at.residuals.size());
}

namespace {

/// A row is read and written as a whole.
using RowWise = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Divides the rows of one reading by the square root of its covariance alone.
/// @return the logarithm of its determinant
double scale(const Noise& noise, const Linearisation& at, Eigen::Index reading, RowWise& columns) {
  const Eigen::Index readings = at.log_magnitude.size();
  const bool has_phase = columns.rows() > readings;
  const double log_size = (noise.exponent - 1.0) * at.log_magnitude(reading);
  const double size = std::exp(-log_size);
  columns.row(reading) *= size;
  double log_determinant = 2.0 * log_size;
  const double along_magnitude = at.slope(reading).real() * size;
  double along_phase = 0.0;
  if (has_phase) {
    columns.row(readings + reading) *= size / noise.phase_scale;
    log_determinant += 2.0 * (log_size + std::log(noise.phase_scale));
    along_phase = at.slope(reading).imag() * size / noise.phase_scale;
  }
  const double square = along_magnitude * along_magnitude + along_phase * along_phase;
  const double larger = 1.0 + noise.jitter * noise.jitter * square;
  if (noise.jitter == 0.0 || square == 0.0) {
    return log_determinant;
  }
  const double share = (1.0 - 1.0 / std::sqrt(larger)) / square;
  if (has_phase) {
    const Eigen::RowVectorXd along = share * (along_magnitude * columns.row(reading) +
                                              along_phase * columns.row(readings + reading));
    columns.row(reading) -= along_magnitude * along;
    columns.row(readings + reading) -= along_phase * along;
  } else {
    columns.row(reading) *= 1.0 - share * square;
  }
  return log_determinant + std::log(larger);
}

}  // namespace

double whiten(const Noise& noise, const Linearisation& at, Eigen::Ref<Eigen::MatrixXd> white) {
  RowWise columns = white;
  const Eigen::Index readings = at.log_magnitude.size();
  double log_determinant = 0.0;
  for (Eigen::Index i = 0; i < readings; ++i) {
    log_determinant += scale(noise, at, i, columns);
  }
  const double own_share = 1.0 - noise.correlated_share;
  const double forgetting = noise.memory * noise.memory;
  Eigen::RowVectorXd state(columns.cols());
  Eigen::RowVectorXd innovation(columns.cols());
  for (Eigen::Index begin = 0; noise.correlated_share > 0.0 && begin < columns.rows();
       begin += readings) {
    state.setZero();
    double variance = noise.correlated_share;  // of the state, before the reading
    for (Eigen::Index i = 0; i < readings; ++i) {
      const double seen = variance + own_share;
      innovation = columns.row(begin + i) - state;
      columns.row(begin + i) = innovation / std::sqrt(seen);
      log_determinant += std::log(seen);
      state = noise.memory * (state + variance / seen * innovation);
      variance =
          forgetting * variance * own_share / seen + (1.0 - forgetting) * noise.correlated_share;
    }
  }
  white = columns;
  return log_determinant;
}

double restricted_deviance(const Linearisation& at, const Noise& noise) {
  const Eigen::Index p = at.jacobian.cols();
  Eigen::MatrixXd columns(at.residuals.size(), p + 1);
  columns << at.jacobian, at.residuals;
  // Columns of length 1: the determinant changes by a constant alone.
  columns.leftCols(p).array().rowwise() /= at.jacobian.colwise().norm().array();
  const double log_determinant = whiten(noise, at, columns);
  const Eigen::MatrixXd normal = columns.transpose() * columns;
  const Eigen::LDLT<Eigen::MatrixXd> solver(normal.topLeftCorner(p, p));
  const Eigen::VectorXd right = normal.topRightCorner(p, 1);
  const double left = normal(p, p) - right.dot(solver.solve(right));
  const auto freedom = static_cast<double>(at.residuals.size() - p);
  return log_determinant + solver.vectorD().array().abs().log().sum() + freedom * std::log(left);
}

namespace {

/// A property of the noise, as the search varies it.
struct Property {
  double least;
  double most;
  void (*set)(Noise& noise, double value);
};

constexpr double most_memory = 0.999;

const Property phase_scale = {
    -4.6, 4.6, [](Noise& noise, double value) { noise.phase_scale = std::exp(value); }};
const Property jitter = {-3.0, 7.0,
                         [](Noise& noise, double value) { noise.jitter = std::exp(value); }};
const Property share = {0.0, 0.999,
                        [](Noise& noise, double value) { noise.correlated_share = value; }};
/// By its distance from 1.
const Property memory = {-6.9, -0.1, [](Noise& noise, double value) {
                           noise.memory = std::min(1.0 - std::exp(value), most_memory);
                         }};

/// The best value of one property; the others stay.
void improve(const Linearisation& at, Noise& noise, double& deviance, const Property& property) {
  constexpr int bits = 14;
  std::uintmax_t evaluations = 24;
  Noise tried = noise;
  const auto [value, found] = boost::math::tools::brent_find_minima(
      [&](double x) {
        property.set(tried, x);
        return restricted_deviance(at, tried);
      },
      property.least, property.most, bits, evaluations);
  if (found < deviance) {
    property.set(noise, value);
    deviance = found;
  }
}

/// What a further property has to gain, so much that it is certain: sizes that follow a few quiet
/// readings make the intervals too short.
constexpr double price = 6.0;

void improve_if_worth_it(const Linearisation& at, Noise& noise, double& deviance,
                         const Property& property) {
  Noise tried = noise;
  double found = deviance;
  improve(at, tried, found, property);
  if (deviance - found > price) {
    noise = tried;
    deviance = found;
  }
}

void take_best_whole_exponent(const Linearisation& at, Noise& noise, double& deviance) {
  for (const double each : {0.0, 1.0, 2.0}) {
    Noise tried = noise;
    tried.exponent = each;
    const double found = restricted_deviance(at, tried);
    if (found < deviance) {
      noise = tried;
      deviance = found;
    }
  }
}

/// The likelihood has several maxima in the correlation: the best of a few is improved.
void improve_correlation(const Linearisation& at, Noise& noise, double& deviance) {
  const Noise white = noise;
  for (const double each_memory : {0.3, 0.7, 0.9, 0.97}) {
    for (const double each_share : {0.2, 0.6, 0.95}) {
      Noise tried = white;
      tried.memory = each_memory;
      tried.correlated_share = each_share;
      const double found = restricted_deviance(at, tried);
      if (found < deviance) {
        noise = tried;
        deviance = found;
      }
    }
  }
  if (noise.correlated_share > 0.0) {
    improve(at, noise, deviance, share);
    improve(at, noise, deviance, memory);
  }
}

void take_correlation_if_worth_it(const Linearisation& at, Noise& noise, double& deviance) {
  Noise correlated = noise;
  double correlated_deviance = deviance;
  improve_correlation(at, correlated, correlated_deviance);
  take_best_whole_exponent(at, correlated, correlated_deviance);
  if (deviance - correlated_deviance > price) {
    noise = correlated;
    deviance = correlated_deviance;
  }
}

}  // namespace

Noise estimate_noise(const Linearisation& at, Correlation correlation) {
  Noise noise;
  if (is_rounding(at)) {
    return noise;
  }
  double deviance = restricted_deviance(at, noise);
  take_best_whole_exponent(at, noise, deviance);
  improve_if_worth_it(at, noise, deviance, jitter);
  if (correlation == Correlation::estimated) {
    take_correlation_if_worth_it(at, noise, deviance);
  }
  if (at.residuals.size() > at.log_magnitude.size()) {
    improve_if_worth_it(at, noise, deviance, phase_scale);
  }
  return noise;
}

namespace {

/// A fit under one correlation.
struct Supposition {
  double log_weight;
  Eigen::MatrixXd covariance;
  Eigen::VectorXd step;  ///< to its best parameters
};

Supposition suppose(const Linearisation& at, const Noise& noise, double log_prior) {
  Eigen::MatrixXd jacobian = at.jacobian;
  Eigen::VectorXd residuals = at.residuals;
  whiten(noise, at, jacobian);
  whiten(noise, at, residuals);
  const Eigen::MatrixXd normal = inverse_normal_matrix(jacobian);
  Eigen::VectorXd step = -(normal * (jacobian.transpose() * residuals));
  const auto freedom = static_cast<double>(at.residuals.size() - at.jacobian.cols());
  const double variance = (residuals + jacobian * step).squaredNorm() / freedom;
  return {log_prior - 0.5 * restricted_deviance(at, noise), variance * normal, std::move(step)};
}

}  // namespace

Eigen::MatrixXd allow_for_correlation(const Linearisation& at, const Noise& noise) {
  if (is_rounding(at)) {
    return rounding * rounding * inverse_normal_matrix(at.jacobian);
  }
  constexpr double prior_of_none = 0.8;
  constexpr double memories[] = {0.2, 0.5, 0.7, 0.8, 0.88, 0.93, 0.96, 0.98};
  constexpr double shares[] = {0.05, 0.15, 0.3, 0.5, 0.7, 0.85, 0.95, 0.995};
  Noise tried = noise;
  tried.correlated_share = 0.0;
  tried.memory = 0.0;
  std::vector<Supposition> all = {suppose(at, tried, std::log(prior_of_none))};
  const double each_prior = std::log((1.0 - prior_of_none) /
                                     static_cast<double>(std::size(memories) * std::size(shares)));
  for (const double memory_value : memories) {
    for (const double share_value : shares) {
      tried.memory = memory_value;
      tried.correlated_share = share_value;
      all.push_back(suppose(at, tried, each_prior));
    }
  }
  const double most = std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
                        return a.log_weight < b.log_weight;
                      })->log_weight;
  double sum = 0.0;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(at.jacobian.cols(), at.jacobian.cols());
  for (const Supposition& each : all) {
    const double weight = std::exp(each.log_weight - most);
    sum += weight;
    covariance += weight * (each.covariance + each.step * each.step.transpose());
  }
  return covariance / sum;
}

}  // namespace sonoglide::identify::impedance
