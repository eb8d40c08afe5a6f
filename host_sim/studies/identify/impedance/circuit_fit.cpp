#include "host_sim/studies/identify/impedance/circuit_fit.hpp"

#include <algorithm>
#include <cmath>

#include "host_sim/studies/identify/least_squares.hpp"

namespace sonoglide::identify::impedance {
namespace {

using Complex = std::complex<double>;

/// The fitted admittance that weights are taken from.
struct Frame {
  Eigen::VectorXcd admittance_S;
  double mean_log_magnitude;
  Linearisation at;  ///< magnitudes and slopes alone
};

Frame frame_of(const Sweep& sweep, const Circuit& circuit) {
  const auto readings = static_cast<Eigen::Index>(sweep.frequency_Hz.size());
  Frame frame{Eigen::VectorXcd(readings), 0.0, {}};
  frame.at.slope.setZero(readings);
  for (Eigen::Index i = 0; i < readings; ++i) {
    const double f = sweep.frequency_Hz[static_cast<std::size_t>(i)];
    frame.admittance_S(i) = circuit.admittance_S(f);
    if (!circuit.modes.empty()) {
      constexpr double part = 1e-3;  // of a band width
      const double step_Hz = part * circuit.modes.front().bandwidth_Hz;
      frame.at.slope(i) =
          std::log(circuit.admittance_S(f + step_Hz) / circuit.admittance_S(f - step_Hz)) /
          (2.0 * part);
    }
  }
  frame.at.log_magnitude = frame.admittance_S.cwiseAbs().array().log();
  frame.mean_log_magnitude = frame.at.log_magnitude.mean();
  frame.at.log_magnitude.array() -= frame.mean_log_magnitude;
  return frame;
}

Eigen::Index rows_of(const Sweep& sweep) {
  return static_cast<Eigen::Index>(sweep.frequency_Hz.size()) * (sweep.has_phase ? 2 : 1);
}

/// Residuals over the frame's admittance; the sign is that of measured less fitted.
void relative_residuals(const Sweep& sweep, const Parts& parts, const Circuit& circuit,
                        const Frame& frame, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
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

Linearisation linearise(const Sweep& sweep, const Parts& parts, const Circuit& circuit,
                        const Frame& frame) {
  Linearisation at = frame.at;
  at.residuals.resize(rows_of(sweep));
  at.jacobian.resize(rows_of(sweep), parts.size());
  relative_residuals(sweep, parts, circuit, frame, at.residuals, &at.jacobian);
  return at;
}

LeastSquares whitened_problem(const Sweep& sweep, const Parts& parts, const Frame& frame,
                              const Noise& noise) {
  return {rows_of(sweep), parts.size(),
          [&sweep, parts, &frame, &noise](const Eigen::VectorXd& p, Eigen::VectorXd& r,
                                          Eigen::MatrixXd* jacobian) {
            relative_residuals(sweep, parts, to_circuit(p, parts), frame, r, jacobian);
            if (jacobian != nullptr) {
              whiten(noise, frame.at, *jacobian);
            }
            whiten(noise, frame.at, r);
          }};
}

}  // namespace

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
    const Frame frame = frame_of(sweep, fit.circuit);
    if (!frame.at.log_magnitude.allFinite()) {
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
  const Frame frame = frame_of(sweep, fit.circuit);
  fit.at = linearise(sweep, parts, fit.circuit, frame);
  Eigen::MatrixXd jacobian = fit.at.jacobian;
  Eigen::VectorXd residuals = fit.at.residuals;
  whiten(noise, frame.at, jacobian);
  const double log_determinant = whiten(noise, frame.at, residuals);
  fit.converged = fit.converged && residuals.allFinite() && jacobian.allFinite();
  const auto rows = static_cast<double>(residuals.size());
  const double freedom = rows - static_cast<double>(fit.p.size());
  const double least = rounding * rounding;
  fit.variance = std::max(residuals.squaredNorm() / freedom, least);
  // In the admittance itself, not relative to a fit.
  const double log_units = 2.0 * rows * frame.mean_log_magnitude;
  fit.deviance = log_determinant + log_units +
                 rows * std::log(std::max(residuals.squaredNorm() / rows, least));
  if (fit.converged) {
    fit.covariance = fit.variance * inverse_normal_matrix(jacobian);
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

}  // namespace sonoglide::identify::impedance
