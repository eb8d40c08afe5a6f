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

/// Least squares of the whitened relative residuals, weighted by the circuit that the fit before
/// gave, so that weights do not pull at it.
CircuitFit fit_circuit(const Sweep& sweep, const Parts& parts, const Circuit& start,
                       const Noise& noise);

/// The same with the noise estimated in turn, until neither changes.
CircuitFit fit_circuit_and_noise(const Sweep& sweep, const Parts& parts, const Circuit& start,
                                 const Noise& noise,
                                 Correlation correlation = Correlation::estimated);

}  // namespace sonoglide::identify::impedance
