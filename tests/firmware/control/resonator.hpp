/// A resonator for the tests of the controller that holds its vibration: solved in closed form.
#pragma once

#include <complex>

#include "tests/common/constants/pi.hpp"

namespace sonoglide::control {

/// x'' + 2 σ x' + ωn² x = f u cos θ, exact over carrier periods of any frequency, and the mean of
/// the demodulated velocity over each, exact as well. Velocities per unit of the steady one at a
/// drive of 1 on resonance.
class Resonator {
 public:
  using Complex = std::complex<double>;

  Resonator(double quality, double natural_Hz)
      : natural_(tests::two_pi * natural_Hz), sigma_(natural_ / (2.0 * quality)) {}

  void set_natural_Hz(double natural_Hz) { natural_ = tests::two_pi * natural_Hz; }
  double natural_Hz() const { return natural_ / tests::two_pi; }
  double time_s() const { return time_s_; }
  double velocity() const { return velocity_; }
  void knock(double velocity) { velocity_ += velocity; }

  /// z of one carrier period: x' = Re(z e^jθ), mean.
  Complex advance(double frequency_Hz, double amplitude) {
    const Complex j(0.0, 1.0);
    const double omega = tests::two_pi * frequency_Hz;
    const double period_s = 1.0 / frequency_Hz;
    // The steady part, X e^jθ, and the free one, Re(a e^λt).
    const double force = 2.0 * sigma_ * amplitude;
    const Complex steady =
        force / Complex(natural_ * natural_ - omega * omega, 2.0 * sigma_ * omega);
    const Complex rate(-sigma_, std::sqrt(natural_ * natural_ - sigma_ * sigma_));
    const double free_x = displacement_ - steady.real();
    const double free_v = velocity_ - (j * omega * steady).real();
    const Complex free(free_x, (rate.real() * free_x - free_v) / rate.imag());
    const Complex turned = free * std::exp(rate * period_s);
    displacement_ = steady.real() + turned.real();
    velocity_ = (j * omega * steady).real() + (rate * turned).real();
    time_s_ += period_s;
    // (2/T) ∫ Re(λ a e^λt) e^-jωt dt.
    const auto mean = [&](Complex amplitude_, Complex rate_) {
      const Complex exponent = (rate_ - j * omega) * period_s;
      return rate_ * amplitude_ * (std::exp(exponent) - 1.0) / exponent;
    };
    return j * omega * steady + mean(free, rate) + mean(std::conj(free), std::conj(rate));
  }

 private:
  double natural_;
  double sigma_;
  double time_s_ = 0.0;
  double displacement_ = 0.0;
  double velocity_ = 0.0;
};

}  // namespace sonoglide::control
