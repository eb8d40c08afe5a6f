/// Table 1 of the paper in numbers: the plant that most scenes of the tests begin from.
#pragma once

#include "tests/common/constants/pi.hpp"

namespace sonoglide::tests {

/// In SI units. The normal force is the weight of the mass.
struct Table1 {
  static constexpr double mass_kg = 0.02;
  static constexpr double stiffness_N_per_m = 133e6;
  static constexpr double friction_coefficient = 0.1;
  static constexpr double normal_force_N = mass_kg * 9.81;
  static constexpr double friction_limit_N = friction_coefficient * normal_force_N;
  static constexpr double contact_stiffness_N_per_m = 0.056e6;
  static constexpr double carrier_Hz = 60e3;
  static constexpr double carrier_rad_per_s = two_pi * carrier_Hz;
  /// The drive force that accelerates the free mass by a unit of displacement.
  static constexpr double inertia_N_per_m = mass_kg * carrier_rad_per_s * carrier_rad_per_s;
  /// Vibration of the steady state for a unit of drive force, without friction.
  static constexpr double compliance_m_per_N = 1.0 / (inertia_N_per_m - stiffness_N_per_m);
};

/// The same in units of plant::Model: time 1 / omega, and the length by which the drive force
/// moves the free mass, so that the drive amplitude is 1.
struct DimensionlessTable1 {
  double contact_stiffness;  ///< kappa
  double friction_force;     ///< beta
  double stiffness;          ///< k
  double vibration;          ///< amplitude of displacement and velocity on the steady orbit

  constexpr explicit DimensionlessTable1(double force_amplitude_N)
      : contact_stiffness(Table1::contact_stiffness_N_per_m * force_amplitude_N /
                          Table1::inertia_N_per_m / Table1::friction_limit_N),
        friction_force(Table1::friction_limit_N / force_amplitude_N),
        stiffness(Table1::stiffness_N_per_m / Table1::inertia_N_per_m),
        vibration(1.0 / (1.0 - stiffness)) {}
};

}  // namespace sonoglide::tests
