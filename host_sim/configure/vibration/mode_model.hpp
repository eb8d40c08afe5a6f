/// A resonator under a carrier whose amplitude changes from period to period, as its vibration
/// shows it once per carrier period.
#pragma once

#include <Eigen/Core>
#include <complex>

namespace sonoglide::configure {

/// Time in carrier periods, velocities in any unit U, amplitudes per full drive.
struct Resonator {
  double stiffness;  ///< (ωn T)²
  double damping;    ///< c T/m
  double push;       ///< F T/m of full drive, in U
};

/// w the free velocity as a phasor at the carrier's phase 0, in (real, imaginary) parts: the free
/// motion is Re(w exp(λ t)), λ = −c/2m + j ωd. z the vibration demodulated over a period, in phase
/// with the drive and in quadrature:
///   w' = A w + B (u' − u),   z = C w + H u.
/// Twice the mean square of the free velocity over a period is w·square w.
struct ModeModel {
  Eigen::Matrix2d rotation;
  Eigen::Vector2d input_gain;
  Eigen::Vector2d forced;
  Eigen::Matrix2d output;
  Eigen::Matrix2d square;
};

/// λ of the free motion, per carrier period.
std::complex<double> rate_of(const Resonator& resonator);

/// Mean of exp(rate t) over t from 0 to 1.
std::complex<double> mean_of_exponential(std::complex<double> rate);

/// @param resonator  with a natural mode: damping²/4 < stiffness; not undamped on the carrier
ModeModel mode_model(const Resonator& resonator);

/// What a change of the amplitude adds to the free motion when it does not come at once: magnitude over
/// that of a jump at phase 0, as they are at the end of the carrier period. A jump at phase φ kicks an
/// undamped mode by
///   K(φ) = ½(1 + 1/a) e^{j(1−a)φ} + ½(1 − 1/a) e^{−j(1+a)φ},   a = ωn/ω,
/// and a linear change over the period by the mean of K, which is 0 at every whole a from 2 on.
///
/// @param resonator  as of mode_model()
/// @param parts      1: linear; n > 1: a staircase of n equal parts of the period, each with the
///                   amplitude of the line in its middle
double ramp_kick(const Resonator& resonator, int parts);

/// The mode turns by at least 0.4 radians in a period: one that turns less, next to a multiple of
/// the carrier, is moved by where the amplitude is and hardly by the way there.
bool is_quick(const ModeModel& model);

/// Of a linear observer of w and of a constant o beside it: z = C w + H u + o.
struct ObserverGains {
  Eigen::Matrix2d mode;
  Eigen::Matrix2d offset;
};

/// Kalman filter that has been at rest for 128 periods.
/// @param process  variance that a period adds to each of w and o
/// @param noise    variance of each part of a sample
ObserverGains observer_gains(const ModeModel& model, double process, double noise);

/// Quadratic form of (w, u − u*), u* the amplitude to come to: the mean square of what the velocity
/// has beside the steady vibration of u*, of a mode next to a multiple of the carrier what z shows
/// of it.
Eigen::Matrix3d vibration_error(const ModeModel& model);

/// Linear-quadratic feedback of (w, u − u*) on the change of the amplitude. A change costs as much
/// as an error of the amplitude of the same size. The poles have a modulus below 1/`stability`.
/// @param error  what (w, u − u*) costs
Eigen::RowVector3d feedback_gains(const ModeModel& model, const Eigen::Matrix3d& error,
                                  double stability);

}  // namespace sonoglide::configure
