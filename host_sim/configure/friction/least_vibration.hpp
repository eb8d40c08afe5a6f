/// The smallest vibration that gives a friction ratio.
#pragma once

#include <optional>

#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// For one ratio after another, each less than the one before, at one sliding speed. It looks from a
/// vibration that hardly lowers the friction upwards, in steps of a quarter of an octave: of several vibrations
/// that give a ratio it finds the smallest, unless a ratio is fallen below and passed again in one step.
///
/// Error: 1e-4 in friction ratio.
class LeastVibration {
 public:
  /// @param contact            outlives this
  /// @param carrier_rad_per_s  ω
  /// @param sliding_m_per_s    > 0
  /// @param strongest_m_per_s  peak velocity where it ends; where the contact opens before, there
  LeastVibration(const scene::Friction& contact, double carrier_rad_per_s, double sliding_m_per_s,
                 double strongest_m_per_s);

  /// Peak velocity. Where no vibration has the ratio, that of the lowest one.
  double vibration_m_per_s(double ratio);

  /// The lowest ratio, once it was asked for less, where no stronger vibration leads below.
  std::optional<double> least_ratio() const;

 private:
  struct Place {
    double velocity_m_per_s;
    double ratio;
  };

  Place at(double velocity_m_per_s) const;
  void advance();
  void refine_lowest();
  Place root(double ratio) const;

  const scene::Friction& contact_;
  double omega_;
  double sliding_m_per_s_;
  double most_m_per_s_;
  bool opens_;  ///< the contact, at the largest vibration
  Place before_{};
  Place above_{};
  Place below_{};
  Place lowest_{};
};

}  // namespace sonoglide::configure
