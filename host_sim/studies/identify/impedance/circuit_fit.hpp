/// A circuit fitted to a sweep.
#pragma once

#include <Eigen/Core>

#include "host_sim/studies/identify/impedance/circuit.hpp"
#include "host_sim/studies/identify/impedance/noise.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

/// How well a circuit describes a sweep. Root mean squares of ln(measured/fitted), a reading with phase
/// counting once.
struct Description {
  double residual = 0.0;
  double scatter = 0.0;  ///< the part of it from reading to reading; its rest is misfit

  double misfit() const;  ///< root mean square too
  /// Residuals above twice the scatter, and above 0.1 %.
  bool fails() const;
};

struct CircuitFit {
  Parts parts;
  Circuit circuit = {};
  Noise noise;
  Linearisation at;
  Description description;
  double variance = 0.0;  ///< σ² of the whitened residuals, at least that of rounding
  /// Of the circuit's vector, with that variance; 0 of what is not fitted.
  Eigen::MatrixXd covariance;
  double deviance = 0.0;  ///< −2 ln likelihood, comparable between circuits of one sweep
  bool converged = false;
};

/// Residuals and slopes at a circuit, whether it is the best one or not.
Linearisation linearise(const Sweep& sweep, const Parts& parts, const Circuit& circuit);

/// A matrix over what is fitted as one over the circuit's vector.
Eigen::MatrixXd over_vector(const Eigen::MatrixXd& fitted, const Parts& parts);

/// A circuit as if it were the best one; not converged where the circuit has no finite admittance.
CircuitFit fit_at(const Sweep& sweep, const Parts& parts, const Circuit& circuit,
                  const Noise& noise);

/// Least squares of the whitened residuals, weighted by the circuit that the fit before gave, so that
/// weights do not pull at it.
CircuitFit fit_circuit(const Sweep& sweep, const Parts& parts, const Circuit& start,
                       const Noise& noise);

/// Schwarz's criterion: −2 ln likelihood and ln n for each parameter.
double schwarz(const CircuitFit& fit);

}  // namespace sonoglide::identify::impedance
