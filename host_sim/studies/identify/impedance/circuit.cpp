#include "host_sim/studies/identify/impedance/circuit.hpp"

#include <cmath>

namespace sonoglide::identify::impedance {
namespace {

using Complex = std::complex<double>;

/// (f² − fs²)/(f Δ)
double detuning(const Mode& mode, double frequency_Hz) {
  return (frequency_Hz - mode.resonance_Hz) * (frequency_Hz + mode.resonance_Hz) /
         (frequency_Hz * mode.bandwidth_Hz);
}

Complex branch_S(const Mode& mode, double frequency_Hz) {
  return mode.conductance_S / Complex(1.0, detuning(mode, frequency_Hz));
}

Complex clamped_S(const Circuit& circuit, double frequency_Hz) {
  return two_pi * frequency_Hz * circuit.clamped_capacitance_F * Complex(circuit.loss_tangent, 1.0);
}

Complex behind_lead_S(const Circuit& circuit, double frequency_Hz) {
  Complex sum = clamped_S(circuit, frequency_Hz);
  for (const Mode& mode : circuit.modes) {
    sum += branch_S(mode, frequency_Hz);
  }
  return sum;
}

}  // namespace

double Mode::inductance_H() const {
  return resistance_ohm() / (two_pi * bandwidth_Hz);
}

double Mode::capacitance_F() const {
  return 1.0 / (two_pi * two_pi * resonance_Hz * resonance_Hz * inductance_H());
}

Complex Lead::impedance_ohm(double frequency_Hz) const {
  return {resistance_ohm, two_pi * frequency_Hz * inductance_H};
}

Complex Circuit::admittance_S(double frequency_Hz) const {
  const Complex behind_S = behind_lead_S(*this, frequency_Hz);
  return behind_S / (1.0 + lead.impedance_ohm(frequency_Hz) * behind_S);
}

Complex Circuit::share_behind_lead(double frequency_Hz) const {
  const Complex divider =
      1.0 + lead.impedance_ohm(frequency_Hz) * behind_lead_S(*this, frequency_Hz);
  return 1.0 / (divider * divider);
}

double Circuit::antiresonance_Hz() const {
  return modes.front().resonance_Hz *
         std::sqrt(1.0 + modes.front().capacitance_F() / clamped_capacitance_F);
}

double Circuit::coupling() const {
  const double motional_F = modes.front().capacitance_F();
  return std::sqrt(motional_F / (clamped_capacitance_F + motional_F));
}

Eigen::VectorXd to_vector(const Circuit& circuit, Parts parts) {
  Eigen::VectorXd p(parameters(parts));
  p(0) = std::log(circuit.clamped_capacitance_F);
  if (parts.loss_tangent) {
    p(1) = circuit.loss_tangent;
  }
  if (has_resistance(parts.lead)) {
    p(first_of_lead(parts)) = circuit.lead.resistance_ohm;
  }
  if (has_inductance(parts.lead)) {
    p(inductance_of_lead(parts)) = circuit.lead.inductance_H / microhenry_H;
  }
  Eigen::Index at = first_mode(parts);
  for (const Mode& mode : circuit.modes) {
    p.segment<3>(at) << std::log(mode.conductance_S), std::log(mode.resonance_Hz),
        std::log(mode.bandwidth_Hz);
    at += 3;
  }
  return p;
}

Circuit to_circuit(const Eigen::VectorXd& p, Parts parts) {
  Circuit circuit{std::exp(p(0)), parts.loss_tangent ? p(1) : 0.0, {}};
  if (has_resistance(parts.lead)) {
    circuit.lead.resistance_ohm = p(first_of_lead(parts));
  }
  if (has_inductance(parts.lead)) {
    circuit.lead.inductance_H = microhenry_H * p(inductance_of_lead(parts));
  }
  for (Eigen::Index at = first_mode(parts); at < p.size(); at += 3) {
    circuit.modes.push_back({std::exp(p(at)), std::exp(p(at + 1)), std::exp(p(at + 2))});
  }
  return circuit;
}

Complex admittance_S(const Circuit& circuit, Parts parts, double frequency_Hz,
                     Eigen::VectorXcd& derivatives) {
  constexpr Complex j(0.0, 1.0);
  Complex sum = clamped_S(circuit, frequency_Hz);
  derivatives.setZero();
  derivatives(0) = sum;
  if (parts.loss_tangent) {
    derivatives(1) = two_pi * frequency_Hz * circuit.clamped_capacitance_F;
  }
  Eigen::Index at = first_mode(parts);
  for (const Mode& mode : circuit.modes) {
    const double d = detuning(mode, frequency_Hz);
    const Complex y = mode.conductance_S / Complex(1.0, d);
    const Complex slope = -j * y * y / mode.conductance_S;  // dy/dd
    derivatives(at) = y;
    derivatives(at + 1) =
        slope * (-2.0 * mode.resonance_Hz * mode.resonance_Hz / (frequency_Hz * mode.bandwidth_Hz));
    derivatives(at + 2) = slope * -d;
    sum += y;
    at += 3;
  }
  if (parts.lead == LeadModel::none) {
    return sum;
  }
  const Complex divider = 1.0 + circuit.lead.impedance_ohm(frequency_Hz) * sum;
  const Complex y = sum / divider;
  derivatives /= divider * divider;
  if (has_resistance(parts.lead)) {
    derivatives(first_of_lead(parts)) = -y * y;
  }
  if (has_inductance(parts.lead)) {
    derivatives(inductance_of_lead(parts)) = -j * two_pi * frequency_Hz * microhenry_H * y * y;
  }
  return y;
}

}  // namespace sonoglide::identify::impedance
