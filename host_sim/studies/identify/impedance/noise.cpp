#include "host_sim/studies/identify/impedance/noise.hpp"

#include <Eigen/QR>
#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
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
  const double log_determinant = whiten(noise, at, columns);
  const Eigen::HouseholderQR<Eigen::MatrixXd> solver(columns);
  const Eigen::MatrixXd all = solver.matrixQR().topRows(p + 1);
  const auto freedom = static_cast<double>(at.residuals.size() - p);
  const double left = all(p, p) * all(p, p);
  const double variance = std::max(left / freedom, rounding * rounding);
  Eigen::MatrixXd stacked = Eigen::MatrixXd::Zero(2 * p, p + 1);
  stacked.topRows(p) = all.topRows(p).triangularView<Eigen::Upper>();
  constexpr double beforehand = 10.0;
  stacked.bottomRows(p).diagonal().tail(3 * at.modes).setConstant(std::sqrt(variance) / beforehand);
  const Eigen::MatrixXd known = Eigen::HouseholderQR<Eigen::MatrixXd>(stacked).matrixQR();
  const Eigen::MatrixXd inverse = known.topLeftCorner(p, p).triangularView<Eigen::Upper>().solve(
      Eigen::MatrixXd::Identity(p, p));
  return {-inverse * known.col(p).head(p), variance * inverse * inverse.transpose(),
          log_determinant + 2.0 * all.diagonal().head(p).array().abs().log().sum() +
              freedom * std::log(left)};
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
        return solve(at, tried).deviance;
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
    const double found = solve(at, tried).deviance;
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
      const double found = solve(at, tried).deviance;
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
  double deviance = solve(at, noise).deviance;
  take_best_whole_exponent(at, noise, deviance);
  if (correlation == Correlation::estimated) {
    take_correlation_if_worth_it(at, noise, deviance);
    if (noise.correlated_share == 0.0) {
      improve_if_worth_it(at, noise, deviance, jitter);
    }
  }
  if (at.residuals.size() > at.log_magnitude.size()) {
    improve_if_worth_it(at, noise, deviance, phase_scale);
  }
  return noise;
}

namespace {

/// What the noise may be beside white, each with its probability before the readings.
std::vector<std::pair<Noise, double>> suppositions(const Noise& noise) {
  constexpr double prior_of_white = 0.6;
  constexpr double memories[] = {0.2, 0.5, 0.7, 0.8, 0.88, 0.93, 0.96, 0.98};
  constexpr double shares[] = {0.05, 0.15, 0.3, 0.5, 0.7, 0.85, 0.95, 0.995};
  Noise tried = noise;
  tried.correlated_share = 0.0;
  std::vector<std::pair<Noise, double>> all = {{tried, prior_of_white}};
  for (const double jitter_value : {0.7, 1.4, 2.8}) {
    constexpr double prior = 0.05;
    all.emplace_back(tried, noise.jitter > 0.0 ? 0.0 : prior);
    all.back().first.jitter = jitter_value;
  }
  const auto count = static_cast<double>(std::size(memories) * std::size(shares));
  for (const double memory_value : memories) {
    for (const double share_value : shares) {
      tried.memory = memory_value;
      tried.correlated_share = share_value;
      all.emplace_back(tried, (1.0 - prior_of_white) / count);
    }
  }
  return all;
}

}  // namespace

Eigen::MatrixXd allow_for_noise(const Linearisation& at, const Noise& noise) {
  const Eigen::Index p = at.jacobian.cols();
  if (is_rounding(at)) {
    return solve(at, noise).covariance;
  }
  std::vector<std::pair<Solution, double>> solutions;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [each, prior] : suppositions(noise)) {
    solutions.emplace_back(solve(at, each), prior);
    least = std::min(least, solutions.back().first.deviance);
  }
  double sum = 0.0;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(p, p);
  for (const auto& [solution, prior] : solutions) {
    const double weight = prior * std::exp(0.5 * (least - solution.deviance));
    sum += weight;
    covariance += weight * (solution.covariance + solution.step * solution.step.transpose());
  }
  return covariance / sum;
}

}  // namespace sonoglide::identify::impedance
