/// What the plant's dimensionless quantities are multiples of.
#pragma once

namespace sonoglide::scene {

/// Time is in 1/ω, displacement in L, force in m L ω², friction in Fc.
struct PlantScales {
  double angular_frequency_rad_per_s;  ///< ω: the drive's, or the plant's own where there is none
  double length_m;                     ///< L, of the size of the motion to come
  double force_N;                      ///< m L ω²
  double friction_N;                   ///< Fc, 0 without friction

  double velocity_m_per_s() const { return length_m * angular_frequency_rad_per_s; }
  /// A contact's stiffness in units of Fc/L: kappa = Kt L/Fc.
  double contact_stiffness(double stiffness_N_per_m) const {
    return stiffness_N_per_m * length_m / friction_N;
  }
};

}  // namespace sonoglide::scene
