#include "host_sim/loop/electrical.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "firmware/numeric/gauss_legendre.hpp"
#include "firmware/numeric/turn.hpp"

namespace sonoglide::loop {
namespace {

/// ∫cos², ∫sin² and ∫sin cos of the drive's phase over a stretch [s].
struct CarrierIntegrals {
  double cosine_square_s;
  double sine_square_s;
  double product_s;
};

CarrierIntegrals carrier_integrals(const Stretch& stretch) {
  const double rate = stretch.drive_rate_rad_per_s;
  const double angle = rate * stretch.duration_s;
  const double middle = stretch.drive_phase_rad + 0.5 * angle;
  // sin 2b - sin 2a = 2 cos(a + b) sin(b - a), and so on: no cancellation.
  const double swing_s = 0.5 * std::cos(2.0 * middle) * std::sin(angle) / rate;
  const double product_s = 0.5 * std::sin(2.0 * middle) * std::sin(angle) / rate;
  return {0.5 * stretch.duration_s + swing_s, 0.5 * stretch.duration_s - swing_s, product_s};
}

/// The voltage is V = p cos θ, p = amplitude + slope θ. What depends on it alone is integrated by
/// Gauss-Legendre quadrature; what depends on the motion too is
///   ∫V x' dt = amplitude c + slope c1,   ∫p sin θ x' dt = amplitude s + slope s1,
///   ∫V' x' dt = ω (slope c - amplitude s - slope s1),
/// c, s, c1, s1 the integrals of x' and x' θ times cos θ and sin θ.
ElectricalBalance balance_of_ramp(const scene::Transducer& transducer, const Stretch& stretch,
                                  const EnergyBalance& energy) {
  const double factor = transducer.force_factor_N_per_V;
  const double rate = stretch.drive_rate_rad_per_s;
  const double first_V = transducer.voltage_V(stretch.drive_amplitude_N);
  const double slope_V = transducer.voltage_V(stretch.drive_slope_N_per_rad);
  const double capacitance_F = transducer.clamped_capacitance_F;
  const double conductance_S = clamped_admittance_S(transducer, rate).real();
  const auto [c, s] = std::array{energy.velocity_in_phase_m, energy.velocity_quadrature_m};
  const double voltage_motion = first_V * c + slope_V * energy.velocity_in_phase_moment_m;
  const double quadrature_motion = first_V * s + slope_V * energy.velocity_quadrature_moment_m;

  ElectricalBalance balance;
  balance.duration_s = stretch.duration_s;
  balance.mechanical_J = energy.drive_work_J;
  balance.input_J = factor * voltage_motion;
  balance.reactive_J = factor * quadrature_motion;
  balance.current_square_A2_s = factor * factor * energy.velocity_square_m2_per_s +
                                2.0 * factor *
                                    (capacitance_F * rate * (slope_V * c - quadrature_motion) +
                                     conductance_S * voltage_motion);
  static constexpr auto rule = numeric::gauss_legendre<24>();
  for (std::size_t i = 0; i < rule.node.size(); ++i) {
    const double weight_s = rule.weight[i] * stretch.duration_s;
    const double phase = stretch.drive_phase_rad + rate * (rule.node[i] * stretch.duration_s);
    const double peak_V = first_V + slope_V * phase;
    const double voltage_V = peak_V * std::cos(phase);
    const double quadrature_V = peak_V * std::sin(phase);
    const double rise_V_per_s = rate * (slope_V * std::cos(phase) - quadrature_V);
    const double current_A = capacitance_F * rise_V_per_s + conductance_S * voltage_V;
    balance.input_J += weight_s * voltage_V * current_A;
    balance.losses_J += weight_s * conductance_S * voltage_V * voltage_V;
    balance.reactive_J += weight_s * quadrature_V * current_A;
    balance.voltage_square_V2_s += weight_s * voltage_V * voltage_V;
    balance.current_square_A2_s += weight_s * current_A * current_A;
  }
  const double end_phase = stretch.drive_phase_rad + rate * stretch.duration_s;
  const double begin_V =
      (first_V + slope_V * stretch.drive_phase_rad) * std::cos(stretch.drive_phase_rad);
  const double end_V = (first_V + slope_V * end_phase) * std::cos(end_phase);
  balance.stored_change_J = 0.5 * capacitance_F * (end_V - begin_V) * (end_V + begin_V);
  return balance;
}

}  // namespace

void ElectricalBalance::append(const ElectricalBalance& next) {
  duration_s += next.duration_s;
  input_J += next.input_J;
  mechanical_J += next.mechanical_J;
  stored_change_J += next.stored_change_J;
  losses_J += next.losses_J;
  reactive_J += next.reactive_J;
  voltage_square_V2_s += next.voltage_square_V2_s;
  current_square_A2_s += next.current_square_A2_s;
  voltage_peak_V = std::fmax(voltage_peak_V, next.voltage_peak_V);
  current_peak_A = std::fmax(current_peak_A, next.current_peak_A);
}

ElectricalFigures electrical_figures(const ElectricalBalance& balance) {
  const double time_s = balance.duration_s;
  const double active_W = balance.input_J / time_s;
  const double apparent_VA =
      std::sqrt(balance.voltage_square_V2_s * balance.current_square_A2_s) / time_s;
  const double residual_J =
      balance.input_J - balance.mechanical_J - balance.stored_change_J - balance.losses_J;
  const double largest_J = std::max({std::abs(balance.input_J), std::abs(balance.mechanical_J),
                                     std::abs(balance.stored_change_J), balance.losses_J});
  return {balance.voltage_peak_V,
          balance.current_peak_A,
          active_W,
          balance.reactive_J / time_s,
          apparent_VA,
          apparent_VA > 0.0 ? active_W / apparent_VA : std::numeric_limits<double>::quiet_NaN(),
          largest_J > 0.0 ? std::abs(residual_J) / largest_J : 0.0};
}

std::complex<double> clamped_admittance_S(const scene::Transducer& transducer,
                                          double rate_rad_per_s) {
  const double susceptance_S = rate_rad_per_s * transducer.clamped_capacitance_F;
  return {susceptance_S * transducer.loss_tangent, susceptance_S};
}

ElectricalBalance electrical_balance(const scene::Transducer& transducer, const Stretch& stretch,
                                     const EnergyBalance& energy) {
  if (stretch.drive_slope_N_per_rad != 0.0) {
    return balance_of_ramp(transducer, stretch, energy);
  }
  const double factor = transducer.force_factor_N_per_V;
  const double peak_V = transducer.voltage_V(stretch.drive_amplitude_N);
  const std::complex<double> clamped =
      peak_V * clamped_admittance_S(transducer, stretch.drive_rate_rad_per_s);
  const double conduction_A = clamped.real();    // in phase with the voltage
  const double displacement_A = clamped.imag();  // a quarter turn before it
  const auto [cosine_square_s, sine_square_s, product_s] = carrier_integrals(stretch);
  const double in_phase_A_s = factor * energy.velocity_in_phase_m;
  const double quadrature_A_s = factor * energy.velocity_quadrature_m;
  const double begin_V = peak_V * std::cos(stretch.drive_phase_rad);
  const double end_V = peak_V * std::cos(stretch.drive_phase_rad +
                                         stretch.drive_rate_rad_per_s * stretch.duration_s);
  const double half_capacitance_F = 0.5 * transducer.clamped_capacitance_F;

  ElectricalBalance balance;
  balance.duration_s = stretch.duration_s;
  balance.losses_J = peak_V * conduction_A * cosine_square_s;
  balance.input_J = peak_V * (in_phase_A_s - displacement_A * product_s) + balance.losses_J;
  balance.mechanical_J = energy.drive_work_J;
  balance.stored_change_J = half_capacitance_F * (end_V - begin_V) * (end_V + begin_V);
  balance.reactive_J =
      peak_V * (quadrature_A_s - displacement_A * sine_square_s + conduction_A * product_s);
  balance.voltage_square_V2_s = peak_V * peak_V * cosine_square_s;
  balance.current_square_A2_s =
      factor * factor * energy.velocity_square_m2_per_s +
      2.0 * (conduction_A * in_phase_A_s - displacement_A * quadrature_A_s) +
      conduction_A * conduction_A * cosine_square_s +
      displacement_A * displacement_A * sine_square_s -
      2.0 * conduction_A * displacement_A * product_s;
  return balance;
}

std::complex<double> current_A(const scene::Transducer& transducer, const PeriodDrive& drive,
                               double frequency_Hz, std::complex<double> vibration_m_per_s) {
  const double factor = transducer.force_factor_N_per_V;
  const double rate_rad_per_s = numeric::two_pi * frequency_Hz;
  const std::complex<double> current_A =
      factor * vibration_m_per_s +
      drive.fundamental_N() / factor * clamped_admittance_S(transducer, rate_rad_per_s);
  // The fundamental of V' is jω times that of V where V returns to where it began.
  return current_A +
         transducer.clamped_capacitance_F * 2.0 * frequency_Hz * (drive.rise_N() / factor);
}

}  // namespace sonoglide::loop
