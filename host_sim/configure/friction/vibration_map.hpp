/// The map that a controller is fed forward by, in SI units.
#pragma once

#include "host_sim/configure/friction/inverse_design.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// The inverse friction-ratio map of a feedforward, in SI units.
struct VibrationMap {
  scene::FrictionMap kind = scene::FrictionMap::dahl;
  double largest_m_per_s = 0.0;
  double contact = 0.0;                    ///< Kt X/Fc at the largest velocity
  const InverseDesign* inverse = nullptr;  ///< of a tabulated one; outlives this
  double level = 1.0;                      ///< friction level over that of the table

  /// Vibration velocity at which the ratio is reached; the largest where no smaller one reaches it,
  /// 0 for a ratio of 1 and at standstill.
  double velocity_m_per_s(double friction_ratio, double sliding_velocity_m_per_s) const;

 private:
  double tabulated_m_per_s(double friction_ratio, double speed) const;
};

}  // namespace sonoglide::configure
