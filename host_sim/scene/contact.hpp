/// What friction laws share: the contact, and the scales of the plant that it acts on.
#pragma once

namespace sonoglide::scene {

/// dissipative: V = Vt + x'. as_printed: V = Vt - x', as the paper's equations (1) and (2) have it;
/// friction then pumps energy into the vibration.
enum class SignConvention { dissipative, as_printed };

/// The contact, whatever its law.
struct ContactValues {
  double coefficient = 0.0;
  double normal_force_N = 0.0;
  double contact_stiffness_N_per_m = 0.0;  ///< elastic laws only
  double initial_force_N = 0.0;            ///< elastic laws only
  SignConvention sign_convention = SignConvention::dissipative;

  /// Fc = mu N, at 0 s where it changes.
  double limit_N() const { return coefficient * normal_force_N; }
};

/// The inverse friction-ratio maps that a controller is fed forward by: that of Coulomb, that of Dahl, and
/// a table that is made with the design.
enum class FrictionMap { coulomb, dahl, tabulated };

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
