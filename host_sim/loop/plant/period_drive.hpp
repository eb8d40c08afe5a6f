/// The drive over one carrier period.
#pragma once

#include <cmath>
#include <complex>

#include "firmware/numeric/turn.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// A part of a carrier period over which the drive is (amplitude_N + slope_N_per_rad θ) cos θ + bias_N,
/// θ its phase; of another waveform the amplitude alone is there.
struct DrivePart {
  double amplitude_N = 0.0;
  double slope_N_per_rad = 0.0;
  double bias_N = 0.0;
};

/// The amplitude passes from that of the period before to its own at once, along a straight line, or
/// along a staircase of n equal parts, each with the amplitude of the line in its middle, or the nearest
/// that the actuator gives. Of its n + 1 rises the first and the last, at the ends of the period, are
/// half as high as the others.
class PeriodDrive {
 public:
  /// @param before_N  amplitude of the period before; 0 before a run
  PeriodDrive(const scene::Scene& scene, double before_N, double amplitude_N, double bias_N)
      : before_N_(is_linear(scene) ? before_N : amplitude_N),
        after_N_(amplitude_N),
        bias_N_(bias_N),
        parts_(before_N_ != after_N_ ? scene.drive->codes_per_period : 1),
        step_N_(parts_ > 1 ? scene.amplitude_step_N() : 0.0) {}

  /// Amplitudes at the ends of the period, where they differ.
  double begin_N() const { return before_N_; }
  double end_N() const { return after_N_; }

  /// z of the carrier Re(z e^jθ), without its harmonics.
  std::complex<double> fundamental_N() const {
    if (parts_ == 1) {
      return {0.5 * (before_N_ + after_N_), 0.5 * change_N() / numeric::two_pi};
    }
    return sum([](double from, double until) {
      const double swing = 0.25 * (std::sin(2.0 * until) - std::sin(2.0 * from));
      const double square =
          0.5 * (std::cos(until) - std::cos(from)) * (std::cos(until) + std::cos(from));
      return std::complex<double>(0.5 * (until - from) + swing, square) / (0.5 * numeric::two_pi);
    });
  }
  /// Sum over the parts of what the carrier times e^-jθ rises by: 0 where the period ends as it began.
  std::complex<double> rise_N() const {
    if (parts_ == 1) {
      return change_N();
    }
    return sum([](double from, double until) {
      return std::cos(until) * std::polar(1.0, -until) - std::cos(from) * std::polar(1.0, -from);
    });
  }

  /// Equal parts of the period, in each of which the drive is one of DrivePart.
  int parts() const { return parts_; }
  DrivePart part(int index) const {
    if (parts_ == 1) {
      return {before_N_, change_N() / numeric::two_pi, bias_N_};
    }
    const double line_N = before_N_ + change_N() * ((index + 0.5) / parts_);
    return {scene::nearest_multiple(line_N, step_N_), 0.0, bias_N_};
  }

 private:
  static bool is_linear(const scene::Scene& scene) {
    return scene.drive && scene.drive->interpolation == scene::Interpolation::linear;
  }

  /// Of the amplitude of each part times what is told of its phases.
  template <class Of>
  std::complex<double> sum(const Of& of) const {
    std::complex<double> total;
    for (int i = 0; i < parts_; ++i) {
      const double length = numeric::two_pi / parts_;
      total += part(i).amplitude_N * of(i * length, (i + 1) * length);
    }
    return total;
  }

  double change_N() const { return after_N_ - before_N_; }

  double before_N_;
  double after_N_;
  double bias_N_;
  int parts_;
  double step_N_;  ///< between amplitudes of parts; 0: any
};

}  // namespace sonoglide::loop
