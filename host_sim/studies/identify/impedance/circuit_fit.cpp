#include "host_sim/studies/identify/impedance/circuit_fit.hpp"

#include <boost/math/distributions/fisher_f.hpp>

#include <algorithm>
#include <cmath>

#include "host_sim/studies/identify/least_squares.hpp"

namespace sonoglide::identify::impedance {
namespace {

using Complex = std::complex<double>;

/// Of the admittance over a band width.
Eigen::VectorXcd slope_of(const Sweep& sweep, const Circuit& circuit) {
  const auto readings = static_cast<Eigen::Index>(sweep.frequency_Hz.size());
  Eigen::VectorXcd slope = Eigen::VectorXcd::Zero(readings);
  constexpr double part = 1e-3;
  for (Eigen::Index i = 0; i < readings && !circuit.modes.empty(); ++i) {
    const double f = sweep.frequency_Hz[static_cast<std::size_t>(i)];
    const double step_Hz = part * circuit.modes.front().bandwidth_Hz;
    slope(i) = (circuit.admittance_S(f + step_Hz) - circuit.admittance_S(f - step_Hz)) /
               (2.0 * part * circuit.admittance_S(f));
  }
  return slope;
}

/// A linearisation that weights are taken from: without residuals, with slopes where they are used.
Linearisation frame_of(const Sweep& sweep, const Circuit& circuit, bool with_slope) {
  const auto readings = static_cast<Eigen::Index>(sweep.frequency_Hz.size());
  Linearisation frame{{}, {}, 0, Eigen::VectorXcd(readings), {}, 0.0, {}};
  for (Eigen::Index i = 0; i < readings; ++i) {
    frame.admittance_S(i) = circuit.admittance_S(sweep.frequency_Hz[static_cast<std::size_t>(i)]);
  }
  frame.log_magnitude = frame.admittance_S.cwiseAbs().array().log();
  frame.mean_log_magnitude = frame.log_magnitude.mean();
  frame.log_magnitude.array() -= frame.mean_log_magnitude;
  if (with_slope) {
    frame.slope = slope_of(sweep, circuit);
  }
  return frame;
}

Eigen::Index rows_of(const Sweep& sweep) {
  return static_cast<Eigen::Index>(sweep.frequency_Hz.size()) * (sweep.has_phase ? 2 : 1);
}

/// Residuals over the frame's admittance; the sign is that of measured less fitted.
void relative_residuals(const Sweep& sweep, const Parts& parts, const Circuit& circuit,
                        const Linearisation& frame, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
  const auto readings = static_cast<Eigen::Index>(sweep.frequency_Hz.size());
  Eigen::VectorXcd derivatives(parts.size());
  for (Eigen::Index i = 0; i < readings; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Complex y = jacobian != nullptr
                          ? admittance_S(circuit, parts, sweep.frequency_Hz[at], derivatives)
                          : circuit.admittance_S(sweep.frequency_Hz[at]);
    // Of magnitudes alone: the direction of the fitted admittance is all that is seen.
    const Complex scale = sweep.has_phase
                              ? 1.0 / frame.admittance_S(i)
                              : std::conj(y) / (std::abs(y) * std::abs(frame.admittance_S(i)));
    const Complex residual = sweep.has_phase ? (sweep.admittance_S[at] - y) * scale
                                             : (std::abs(sweep.admittance_S[at]) - std::abs(y)) /
                                                   std::abs(frame.admittance_S(i));
    r(i) = residual.real();
    if (sweep.has_phase) {
      r(readings + i) = residual.imag();
    }
    if (jacobian != nullptr) {
      const Eigen::RowVectorXcd row = -scale * derivatives.transpose();
      jacobian->row(i) = row.real();
      if (sweep.has_phase) {
        jacobian->row(readings + i) = row.imag();
      }
    }
  }
}

LeastSquares whitened_problem(const Sweep& sweep, const Parts& parts, const Linearisation& frame,
                              const Noise& noise) {
  return {rows_of(sweep), parts.size(),
          [&sweep, parts, &frame, &noise](const Eigen::VectorXd& p, Eigen::VectorXd& r,
                                          Eigen::MatrixXd* jacobian) {
            relative_residuals(sweep, parts, to_circuit(p, parts), frame, r, jacobian);
            if (jacobian != nullptr) {
              whiten(noise, frame, *jacobian);
            }
            whiten(noise, frame, r);
          }};
}

}  // namespace

Linearisation linearise(const Sweep& sweep, const Parts& parts, const Circuit& circuit) {
  Linearisation at = frame_of(sweep, circuit, true);
  at.residuals.resize(rows_of(sweep));
  at.jacobian.resize(rows_of(sweep), parts.size());
  at.modes = parts.modes;
  relative_residuals(sweep, parts, circuit, at, at.residuals, &at.jacobian);
  return at;
}

Sweep with_logarithmic_residuals(const Sweep& sweep, const Circuit& fitted) {
  Sweep moved = sweep;
  for (std::size_t i = 0; i < moved.frequency_Hz.size(); ++i) {
    const Complex y = fitted.admittance_S(moved.frequency_Hz[i]);
    moved.admittance_S[i] = y * (1.0 + std::log(moved.admittance_S[i] / y));
  }
  return moved;
}

CircuitFit fit_circuit(const Sweep& sweep, const Parts& parts, const Circuit& start,
                       const Noise& noise) {
  CircuitFit fit{parts, start, to_vector(start, parts), noise, {}, 0.0, {}, 0.0, false};
  constexpr int most_rounds = 4;
  for (int round = 0; round < most_rounds; ++round) {
    const Linearisation frame = frame_of(sweep, fit.circuit, noise.jitter > 0.0);
    if (!frame.log_magnitude.allFinite()) {
      fit.converged = false;
      break;
    }
    constexpr double accuracy = 1e-8;
    constexpr int most_evaluations = 80;
    const LeastSquaresFit solved =
        minimise(whitened_problem(sweep, parts, frame, noise), fit.p, accuracy, most_evaluations);
    const double moved = (solved.parameters - fit.p).norm();
    fit.p = solved.parameters;
    fit.circuit = to_circuit(fit.p, parts);
    fit.converged = solved.converged;
    constexpr double small = 1e-6;
    if (!solved.converged || moved < small) {
      break;
    }
  }
  fit.at = linearise(sweep, parts, fit.circuit);
  Eigen::VectorXd residuals = fit.at.residuals;
  const double log_determinant = whiten(noise, fit.at, residuals);
  fit.converged = fit.converged && residuals.allFinite() && fit.at.jacobian.allFinite();
  const auto rows = static_cast<double>(residuals.size());
  const double freedom = rows - static_cast<double>(fit.p.size());
  const double least = rounding * rounding;
  fit.variance = std::max(residuals.squaredNorm() / freedom, least);
  // In the admittance itself, not relative to a fit.
  const double log_units = 2.0 * rows * fit.at.mean_log_magnitude;
  fit.deviance = log_determinant + log_units +
                 rows * std::log(std::max(residuals.squaredNorm() / rows, least));
  if (fit.converged) {
    fit.covariance = solve(fit.at, noise).covariance;
  }
  return fit;
}

CircuitFit fit_circuit_and_noise(const Sweep& sweep, const Parts& parts, const Circuit& start,
                                 const Noise& noise, Correlation correlation) {
  CircuitFit fit = fit_circuit(sweep, parts, start, noise);
  constexpr int rounds = 2;
  for (int round = 0; round < rounds && fit.converged; ++round) {
    fit = fit_circuit(sweep, parts, fit.circuit, estimate_noise(fit.at, correlation));
  }
  return fit;
}

double schwarz(const CircuitFit& fit) {
  return fit.deviance +
         static_cast<double>(fit.p.size()) * std::log(static_cast<double>(fit.at.residuals.size()));
}

double chance(const CircuitFit& smaller, const CircuitFit& larger) {
  const auto rows = static_cast<double>(larger.at.residuals.size());
  const double freedom = rows - static_cast<double>(larger.p.size());
  const auto more = static_cast<double>(larger.p.size() - smaller.p.size());
  const double f = std::expm1((smaller.deviance - larger.deviance) / rows) * freedom / more;
  return f > 0.0 && std::isfinite(f)
             ? boost::math::cdf(boost::math::complement(boost::math::fisher_f(more, freedom), f))
             : (f > 0.0 ? 0.0 : 1.0);
}

}  // namespace sonoglide::identify::impedance
