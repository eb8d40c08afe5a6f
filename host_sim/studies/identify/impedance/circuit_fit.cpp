#include "host_sim/studies/identify/impedance/circuit_fit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "host_sim/studies/identify/least_squares.hpp"

namespace sonoglide::identify::impedance {
namespace {

using Complex = std::complex<double>;

Eigen::Index rows_of(const Sweep& sweep) {
  return static_cast<Eigen::Index>(sweep.frequency_Hz.size()) * (sweep.has_phase ? 2 : 1);
}

void add_residuals(const Sweep& sweep, const Parts& parts, const Circuit& circuit,
                   Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
  const auto readings = static_cast<Eigen::Index>(sweep.frequency_Hz.size());
  const std::vector<Eigen::Index> fitted = parts.indices();
  Eigen::VectorXcd derivatives;
  for (Eigen::Index i = 0; i < readings; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Complex y =
        circuit.admittance_S(sweep.frequency_Hz[at], jacobian != nullptr ? &derivatives : nullptr);
    const Complex inverse = std::conj(y) / std::norm(y);
    const Complex ratio = sweep.admittance_S[at] * inverse;
    r(i) = 0.5 * std::log(std::norm(ratio));
    if (sweep.has_phase) {
      r(readings + i) = std::arg(ratio);
    }
    for (std::size_t k = 0; jacobian != nullptr && k < fitted.size(); ++k) {
      const Complex slope = -derivatives(fitted[k]) * inverse;
      (*jacobian)(i, static_cast<Eigen::Index>(k)) = slope.real();
      if (sweep.has_phase) {
        (*jacobian)(readings + i, static_cast<Eigen::Index>(k)) = slope.imag();
      }
    }
  }
}

/// A linearisation that sizes are taken from, without residuals; with slopes where they are used.
Linearisation weights_of(const Sweep& sweep, const Circuit& circuit, bool with_slope) {
  const auto readings = static_cast<Eigen::Index>(sweep.frequency_Hz.size());
  Linearisation at{{}, {}, 0, Eigen::VectorXd(readings), Eigen::VectorXcd::Zero(readings)};
  double measured = 0.0;
  for (Eigen::Index i = 0; i < readings; ++i) {
    const double f = sweep.frequency_Hz[static_cast<std::size_t>(i)];
    measured += std::log(std::abs(sweep.admittance_S[static_cast<std::size_t>(i)]));
    at.log_magnitude(i) = std::log(std::abs(circuit.admittance_S(f)));
    if (with_slope && !circuit.modes.empty()) {
      constexpr double part = 1e-3;
      const double step_Hz = part * circuit.modes.front().bandwidth_Hz;
      at.slope(i) =
          std::log(circuit.admittance_S(f + step_Hz) / circuit.admittance_S(f - step_Hz)) /
          (2.0 * part);
    }
  }
  at.log_magnitude.array() -= measured / static_cast<double>(readings);
  return at;
}

/// The scatter is taken from the differences of neighbouring residuals, each over the size that the
/// noise gives it, by the 90th percentile of them: flanks of modes that are not fitted are few.
Description describe(const Linearisation& at, const Noise& noise) {
  Eigen::VectorXd scaled = at.residuals;
  whiten(sizes(noise), at, scaled);
  const Eigen::Index readings = at.log_magnitude.size();
  std::vector<double> steps;
  for (Eigen::Index i = 1; i < scaled.size(); ++i) {
    if (i % readings != 0) {
      steps.push_back(std::abs(scaled(i) - scaled(i - 1)));
    }
  }
  constexpr double share = 0.9;
  constexpr double deviations = 1.6449;  // of a Gaussian's |x| at that share
  const auto place =
      steps.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(steps.size() - 1));
  std::nth_element(steps.begin(), place, steps.end());
  const double scatter = *place / (deviations * std::sqrt(2.0));
  const double size = scaled.norm() / std::sqrt(static_cast<double>(scaled.size()));
  const double residual = at.residuals.norm() / std::sqrt(static_cast<double>(readings));
  return {residual, residual * (size > 0.0 ? std::min(scatter / size, 1.0) : 1.0)};
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

Linearisation linearise(const Sweep& sweep, const Parts& parts, const Circuit& circuit) {
  Linearisation at = weights_of(sweep, circuit, true);
  at.residuals.resize(rows_of(sweep));
  at.jacobian.resize(rows_of(sweep), parts.size());
  at.modes = parts.modes;
  add_residuals(sweep, parts, circuit, at.residuals, &at.jacobian);
  return at;
}

Eigen::MatrixXd over_vector(const Eigen::MatrixXd& fitted, const Parts& parts) {
  const Eigen::Index size = first_mode + 3 * static_cast<Eigen::Index>(parts.modes);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(size, size);
  const std::vector<Eigen::Index> indices = parts.indices();
  all(indices, indices) = fitted;
  return all;
}

CircuitFit fit_at(const Sweep& sweep, const Parts& parts, const Circuit& circuit,
                  const Noise& noise) {
  CircuitFit fit{parts, circuit, noise, linearise(sweep, parts, circuit), {}, 0.0, {}, 0.0, false};
  if (!fit.at.residuals.allFinite() || !fit.at.jacobian.allFinite()) {
    return fit;
  }
  fit.converged = true;
  fit.description = describe(fit.at, noise);
  Eigen::VectorXd residuals = fit.at.residuals;
  const double log_determinant = whiten(noise, fit.at, residuals);
  const auto rows = static_cast<double>(residuals.size());
  const double least = rounding * rounding;
  fit.variance =
      std::max(residuals.squaredNorm() / (rows - static_cast<double>(parts.size())), least);
  fit.deviance = log_determinant + rows * std::log(std::max(residuals.squaredNorm() / rows, least));
  fit.covariance = over_vector(solve(fit.at, noise).covariance, parts);
  return fit;
}

CircuitFit fit_circuit(const Sweep& sweep, const Parts& parts, const Circuit& start,
                       const Noise& noise) {
  const std::vector<Eigen::Index> fitted = parts.indices();
  Eigen::VectorXd p = to_vector(start);
  constexpr int most_rounds = 4;
  for (int round = 0; round < most_rounds; ++round) {
    const Linearisation weights = weights_of(sweep, to_circuit(p), noise.jitter > 0.0);
    if (!weights.log_magnitude.allFinite()) {
      return {};
    }
    constexpr double accuracy = 1e-8;
    constexpr int most_evaluations = 80;
    const LeastSquaresFit solved =
        minimise({rows_of(sweep), parts.size(),
                  [&](const Eigen::VectorXd& q, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
                    Eigen::VectorXd all = p;
                    all(fitted) = q;
                    add_residuals(sweep, parts, to_circuit(all), r, jacobian);
                    whiten(noise, weights, r);
                    if (jacobian != nullptr) {
                      whiten(noise, weights, *jacobian);
                    }
                  }},
                 p(fitted), accuracy, most_evaluations);
    if (!solved.converged) {
      return {};
    }
    const double moved = (solved.parameters - p(fitted)).norm();
    p(fitted) = solved.parameters;
    constexpr double small = 1e-6;
    if (moved < small || (noise.exponent == 1.0 && noise.jitter == 0.0)) {
      break;
    }
  }
  return fit_at(sweep, parts, to_circuit(p), noise);
}

double schwarz(const CircuitFit& fit) {
  return fit.deviance + static_cast<double>(fit.parts.size()) *
                            std::log(static_cast<double>(fit.at.residuals.size()));
}

}  // namespace sonoglide::identify::impedance
