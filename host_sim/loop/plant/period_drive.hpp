/// The drive over one carrier period.
#pragma once

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
/// along a staircase of n equal parts, each with the amplitude of the line in its middle: the first and
/// the last of its n + 1 rises, at the ends of the period, are half as high as the others.
class PeriodDrive {
 public:
  /// @param before_N  amplitude of the period before; 0 before a run
  PeriodDrive(const scene::Scene& scene, double before_N, double amplitude_N, double bias_N)
      : before_N_(is_linear(scene) ? before_N : amplitude_N),
        change_N_(amplitude_N - before_N_),
        bias_N_(bias_N),
        parts_(change_N_ != 0.0 ? scene.drive->codes_per_period : 1) {}

  /// Equal parts of the period, in each of which the drive is one of DrivePart.
  int parts() const { return parts_; }
  DrivePart part(int index) const {
    if (parts_ == 1) {
      return {before_N_, change_N_ / numeric::two_pi, bias_N_};
    }
    return {before_N_ + change_N_ * ((index + 0.5) / parts_), 0.0, bias_N_};
  }

 private:
  static bool is_linear(const scene::Scene& scene) {
    return scene.drive && scene.drive->interpolation == scene::Interpolation::linear;
  }

  double before_N_;
  double change_N_;
  double bias_N_;
  int parts_;
};

}  // namespace sonoglide::loop
