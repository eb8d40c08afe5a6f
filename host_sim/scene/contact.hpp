/// What every friction law of a scene shares.
#pragma once

namespace sonoglide::scene {

/// dissipative: V = Vt + x'. as_printed: V = Vt - x', as the paper's equations (1) and (2) have it;
/// friction then pumps energy into the vibration.
enum class SignConvention { dissipative, as_printed };

/// The contact, whatever its law.
struct Contact {
  double coefficient = 0.0;
  double normal_force_N = 0.0;
  double contact_stiffness_N_per_m = 0.0;  ///< elastic laws only
  double initial_force_N = 0.0;            ///< elastic laws only
  SignConvention sign_convention = SignConvention::dissipative;

  /// Fc = mu N, at 0 s where it changes.
  double limit_N() const { return coefficient * normal_force_N; }
};

/// The closed-form friction-ratio maps that a controller is fed forward by.
enum class FrictionMap { coulomb, dahl };

}  // namespace sonoglide::scene
