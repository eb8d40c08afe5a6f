/// A circuit fitted to a sweep.
#pragma once

#include <Eigen/Core>

#include "host_sim/studies/identify/impedance/circuit.hpp"
#include "host_sim/studies/identify/impedance/noise.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

struct CircuitFit {
  Parts parts;
  Circuit circuit;
  Eigen::VectorXd p;  ///< the circuit as a vector
  Noise noise;
  Linearisation at;
  double variance;             ///< σ² of the whitened residuals, at least that of rounding
  Eigen::MatrixXd covariance;  ///< of p, with that variance
  double deviance;             ///< −2 ln likelihood, comparable between circuits of one sweep
  bool converged;
};

/// The sweep with each reading moved to where its relative residual is the logarithm of measured
/// over fitted. Of a phase that scatters by s the real part of the relative residual is −s²/2 on
/// average, which would shift the magnitude; that of the logarithm is 0.
Sweep with_logarithmic_residuals(const Sweep& sweep, const Circuit& fitted);

/// A fit's residuals and slopes, those of parts that the circuit does not have at their 0.
Linearisation linearise(const Sweep& sweep, const Parts& parts, const Circuit& circuit);

/// Least squares of the whitened relative residuals, weighted by the circuit that the fit before
/// gave, so that weights do not pull at it.
CircuitFit fit_circuit(const Sweep& sweep, const Parts& parts, const Circuit& start,
                       const Noise& noise);

/// The same with the noise estimated in turn, until neither changes.
CircuitFit fit_circuit_and_noise(const Sweep& sweep, const Parts& parts, const Circuit& start,
                                 const Noise& noise,
                                 Correlation correlation = Correlation::estimated);

/// Schwarz's criterion: −2 ln likelihood and ln n for each parameter.
double schwarz(const CircuitFit& fit);

/// The F test of the larger fit against the smaller one.
/// @return the share of sweeps of the smaller circuit in which the larger one would do as much better
double chance(const CircuitFit& smaller, const CircuitFit& larger);

}  // namespace sonoglide::identify::impedance
