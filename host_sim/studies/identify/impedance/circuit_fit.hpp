/// A circuit fitted to a sweep.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "host_sim/studies/identify/impedance/circuit.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

// What the residuals of a sweep look like: how large they are for which admittance, and how they
// hang together along the sweep.

/// Covariance of the residuals ln(measured/fitted), up to its scale σ²: the real part is an error of
/// the magnitude, the imaginary part one of the phase.
///
/// Standard deviation |Y|^(exponent − 1), of the imaginary part `phase_scale` times that; and an error
/// of each frequency, `jitter` for each band width. The correlation of two readings i apart in the
/// sweep is correlated_share · memory^i, and 1 for i = 0.
struct Noise {
  double exponent = 1.0;  ///< 0: of equal size in the admittance; 1: relative; 2: in Z
  double phase_scale = 1.0;
  double jitter = 0.0;            ///< of a frequency, in band widths, over σ
  double correlated_share = 0.0;  ///< [0, 1)
  double memory = 0.0;            ///< [0, 1)
};

/// The noise without what hangs together and errors of the frequency.
Noise sizes(const Noise& noise);

/// Residuals at a circuit and their Jacobian to what is fitted: the real parts of all readings, then,
/// of a sweep with phase, the imaginary parts.
struct Linearisation {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
  Eigen::Index modes;             ///< of which the last three columns each are
  Eigen::VectorXd log_magnitude;  ///< ln(|Y|/geometric mean of the measured), one a reading
  Eigen::VectorXcd slope;         ///< d ln Y/df times the band width of the first mode, likewise
};

/// Residuals of a root mean square up to this are taken for rounding of computed readings.
inline constexpr double rounding = 1e-9;

/// Whether the residuals are no more than rounding: they tell nothing of noise.
bool is_rounding(const Linearisation& at);

/// Makes columns white, in place: multiplies them by an inverse square root of the covariance. O(n)
/// by the innovations of a Kalman filter: a first-order process seen through white noise.
/// @param at       where sizes and slopes of the readings are taken from
/// @param columns  one or two rows for each reading
/// @return the logarithm of the covariance's determinant
double whiten(const Noise& noise, const Linearisation& at, Eigen::Ref<Eigen::MatrixXd> columns);

/// The least squares of one noise, about the linearisation.
struct Solution {
  Eigen::VectorXd step;  ///< to the best parameters
  /// Of them; what of a mode no reading tells is known to a factor of e^10, standard deviation.
  Eigen::MatrixXd covariance;
  /// Restricted likelihood, −2 ln of it up to a constant: of the residuals with σ² at its best and
  /// the parameters integrated out.
  /// Source: Patterson and Thompson, Biometrika 58 (1971).
  double deviance;
};

Solution solve(const Linearisation& at, const Noise& noise);

/// Whether errors of the frequency and a correlation along the sweep are looked for.
enum class Correlation { none, estimated };

/// The likeliest noise, by the restricted likelihood, of those that average_over_noise goes over; white
/// of rounding. What is not white, or of phases another than of magnitudes, has to gain 6 (−2 ln).
Noise estimate_noise(const Linearisation& at, Correlation correlation);

/// The covariance of the parameters, averaged over what the noise may be, since the likeliest one alone
/// makes the intervals too short: of each noise the covariance, and the square of the step by which its
/// best parameters differ, weighted by its restricted likelihood. White noise has 0.45 of the weight
/// beforehand, errors of the frequency of eight sizes 0.15, and 64 correlations the rest.
/// Source: Hoeting, Madigan, Raftery and Volinsky, Statistical Science 14 (1999).
Eigen::MatrixXd average_over_noise(const Linearisation& at, const Noise& noise);

/// How well a circuit describes a sweep. Root mean squares of ln(measured/fitted), a reading with phase
/// counting once.
struct Description {
  double residual = 0.0;
  double scatter = 0.0;  ///< the part of it from reading to reading; its rest is misfit

  double misfit() const;  ///< root mean square too
  /// Residuals above twice the scatter, and above 0.1 %.
  bool fails() const;
};

/// One of several circuits that may be the right one.
struct Alternative {
  Circuit circuit;
  Eigen::MatrixXd covariance;  ///< of its vector
  double weight;               ///< its probability
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
  /// Where several circuits may be the right one, they and the fit itself; the intervals are those of the
  /// mixture.
  std::vector<Alternative> alternatives = {};
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
