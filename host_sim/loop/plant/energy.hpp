/// Where the energy of a stretch of motion went, in SI units.
#pragma once

#include <complex>

#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// Of a load, likewise; all 0 without one.
///
/// Identity: pull_work = force_work + spring_pull_work − damping_work − (stored_end − stored_begin),
/// pull_work that of the EnergyBalance: what the body gives to the contact.
struct LoadBalance {
  double force_work_J = 0.0;        ///< ∫Fa Vt dt
  double spring_pull_work_J = 0.0;  ///< −∫k (x − ∫vp dt) vp dt, from the pulled end of the spring
  double damping_work_J = 0.0;  ///< ∫c Vt² dt
  double stored_begin_J = 0.0;  ///< M Vt²/2 + k (x − ∫vp dt)²/2
  double stored_end_J = 0.0;

  double change_J() const { return stored_end_J - stored_begin_J; }
};

/// Integrals over a stretch of motion; stretches add up.
///
/// Identity, σ = +1 dissipative, −1 as printed:
///   friction_work = pull_work
///                   + σ (drive_work + spring_work − damping_work − (stored_end − stored_begin)).
/// A load does the work of the pull and has an identity of its own.
struct EnergyBalance {
  double duration_s = 0.0;
  double sliding_distance_m = 0.0;      ///< ∫|Vt| dt
  double friction_impulse_N_s = 0.0;    ///< ∫F dt
  double resistance_impulse_N_s = 0.0;  ///< ∫F·sgn(Vt) dt, sgn(0) = 1
  /// ∫F0 dt / Fc: F0 is what the slide would meet without vibration at its speed and at the
  /// friction of the moment, Fc the scene's largest friction limit.
  double undriven_s = 0.0;
  double limit_distance_m = 0.0;  ///< ∫μN |Vt| dt / Fc, the same Fc
  double friction_work_J = 0.0;   ///< ∫F V dt, into the contact
  double pull_work_J = 0.0;       ///< ∫F Vt dt, from whatever slides
  double drive_work_J = 0.0;      ///< ∫Fe x' dt
  double damping_work_J = 0.0;    ///< ∫c x'² dt
  double spring_work_J = 0.0;     ///< ∫x²/2 dKs, from whatever changes the stiffness
  double stored_begin_J = 0.0;    ///< m x'²/2 + Ks x²/2
  double stored_end_J = 0.0;
  double stored_integral_J_s = 0.0;       ///< ∫(m x'²/2 + Ks x²/2) dt
  double momentum_integral_J_s = 0.0;     ///< ∫m Vt x' dt
  double displacement_square_m2_s = 0.0;  ///< ∫x² dt
  double velocity_square_m2_per_s = 0.0;  ///< ∫x'² dt
  double velocity_in_phase_m = 0.0;  ///< ∫x' cos θ dt, θ the phase of the drive; 0 unless asked for
  double velocity_quadrature_m = 0.0;  ///< ∫x' sin θ dt; likewise
  /// ∫x' θ cos θ dt and ∫x' θ sin θ dt; likewise, and 0 unless the amplitude may change in a period.
  double velocity_in_phase_moment_m = 0.0;
  double velocity_quadrature_moment_m = 0.0;
  double load_s = 0.0;  ///< ∫N/N0 dt where the contact vibrates normally, N0 the force at x = 0
  double normal_impulse_N_s = 0.0;  ///< ∫N dt likewise, N0 that of the middle of a stretch
  double open_s = 0.0;              ///< time in which such a contact is open, N = 0
  LoadBalance load;

  /// z [m/s] of the fundamental Re(z e^jθ) of x' over whole carrier periods.
  std::complex<double> vibration_m_per_s() const;

  /// Appends the stretch that follows.
  void append(const EnergyBalance& next);
  /// Adds a multiple of another's integrals; what is stored at the ends stays.
  void add(const EnergyBalance& other, double times);
};

/// The friction ratio, and energies relative to the limit's work ∫μN |Vt| dt; NaN where what they
/// are relative to is zero. φ_fu = pull + σ (φ_iu − stored change − damping). Under a law whose
/// undriven friction is μN, and where that and Vt are constant, the pull is ρ.
struct PowerRatios {
  double friction_ratio = 0.0;       ///< ρ = ∫F·sgn(Vt) dt / ∫F0 dt, F0 the undriven friction
  double pull_ratio = 0.0;           ///< ∫F Vt dt: put in by whatever slides
  double dissipation_ratio = 0.0;    ///< φ_fu
  double drive_input_ratio = 0.0;    ///< φ_iu
  double stored_change_ratio = 0.0;  ///< change of the oscillator's energy
  double damping_ratio = 0.0;        ///< taken by the damper
  double balance_residual = 0.0;     ///< of the identity, relative to its largest term; with a load
                                     ///< of both identities together
  /// 1 + φ_iu − φ_su, φ_su from the average stored energy; NaN with a load.
  double dissipation_as_printed = 0.0;
  double load_force_ratio = 0.0;          ///< of a load: put in by the applied force
  double load_spring_pull_ratio = 0.0;    ///< by the pulled end of its spring
  double load_damping_ratio = 0.0;        ///< taken by its damper
  double load_stored_change_ratio = 0.0;  ///< change of its energy
};

/// @param friction_N  the scene's largest friction limit
/// @param period_s  carrier period: the paper divides stored energy by the work of one. NaN without
///                  a drive, and there is no printed value then.
PowerRatios power_ratios(const EnergyBalance& energy, double friction_N,
                         scene::SignConvention convention, double period_s);

/// The same for a stretch of a scene.
PowerRatios power_ratios(const scene::Scene& scene, const EnergyBalance& energy);

}  // namespace sonoglide::loop
