/// What a transducer takes from its amplifier, in SI units.
#pragma once

#include <complex>
#include <limits>

#include "host_sim/loop/plant/energy.hpp"
#include "host_sim/loop/plant/period_drive.hpp"
#include "host_sim/loop/plant/plant_port.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// Integrals over stretches of a run.
///
/// The current is i = Nf x' + C0 V' + V/R0, R0 = 1/(ω C0 tan δ). Identity:
///   input = mechanical work + change of C0 V²/2 + losses.
/// A voltage that jumps, at a phase 0 or from one code to the next, charges C0 at once. This charge and its energy, which comes back
/// when the voltage returns, are not in the account.
struct ElectricalBalance {
  double duration_s = 0.0;
  double input_J = 0.0;       ///< ∫V i dt, by quadrature of the motion
  double mechanical_J = 0.0;  ///< ∫Fe x' dt, by the solver's account
  double stored_change_J = 0.0;
  double losses_J = 0.0;             ///< ∫V²/R0 dt
  double reactive_J = 0.0;           ///< ∫Q dt, Q of the fundamental; below 0: capacitive
  double voltage_square_V2_s = 0.0;  ///< ∫V² dt
  double current_square_A2_s = 0.0;  ///< ∫i² dt
  /// Largest amplitudes of the carrier periods that reach into the stretches; of the current's
  /// fundamental, in periods that are not cut short. NaN where there is none.
  double voltage_peak_V = std::numeric_limits<double>::quiet_NaN();
  double current_peak_A = std::numeric_limits<double>::quiet_NaN();

  void append(const ElectricalBalance& next);
};

struct ElectricalFigures {
  double voltage_peak_V;
  double current_peak_A;
  double active_power_W;
  double reactive_power_var;
  double apparent_power_VA;  ///< effective voltage times effective current
  double power_factor;       ///< active over apparent power; NaN without a voltage
  double balance_residual;   ///< of the identity, relative to its largest term
};

ElectricalFigures electrical_figures(const ElectricalBalance& balance);

/// Y = jω C0 (1 - j tan δ) [S]: the transducer's admittance while its mass is held.
std::complex<double> clamped_admittance_S(const scene::Transducer& transducer,
                                          double rate_rad_per_s);

/// Of one stretch under a cosine, without a bias.
/// @param energy  of it, demodulated
ElectricalBalance electrical_balance(const scene::Transducer& transducer, const Stretch& stretch,
                                     const EnergyBalance& energy);

/// The current's fundamental over a carrier period: i = Re(current e^jθ).
/// @param vibration_m_per_s  z of x' = Re(z e^jθ)
std::complex<double> current_A(const scene::Transducer& transducer, const PeriodDrive& drive,
                               double frequency_Hz, std::complex<double> vibration_m_per_s);

}  // namespace sonoglide::loop
