#include "host_sim/studies/identify/impedance/circuit.hpp"

#include <algorithm>
#include <cmath>

namespace sonoglide::identify::impedance {
namespace {

using Complex = std::complex<double>;

/// (f² − fs²)/(f Δ)
double detuning(const Mode& mode, double frequency_Hz) {
  return (frequency_Hz - mode.resonance_Hz) * (frequency_Hz + mode.resonance_Hz) /
         (frequency_Hz * mode.bandwidth_Hz);
}

/// The detuning d of a mode that leans: the least solution of d = d0 + 2 s/(1 + d²), d0 that at a
/// small current. From |s| = 0.77 on there are three about the peak; the least is what a sweep to
/// higher frequencies follows. Cardano's roots of the cubic, then Newton's steps.
double leaning_detuning(double straight, double lean) {
  double d = straight;
  constexpr double far = 1e3;  // where the lean is next to nothing and Cardano's terms cancel
  if (std::abs(straight) < far) {
    const double third = straight / 3.0;
    const double slope = 1.0 / 3.0 - third * third;
    const double half = -third * (third * third + 1.0) - lean;
    const double square = half * half + slope * slope * slope;
    if (square > 0.0) {
      const double root = std::cbrt(-half - std::copysign(std::sqrt(square), half));
      d = third + root - slope / root;
    } else {
      const double size = std::sqrt(-slope);
      const double angle = std::acos(std::clamp(-half / (size * size * size), -1.0, 1.0));
      d = third + 2.0 * size * std::cos((angle + two_pi) / 3.0);
    }
  }
  constexpr int steps = 2;
  for (int i = 0; i < steps; ++i) {
    const double power = 1.0 / (1.0 + d * d);
    const double slope = 1.0 + 4.0 * lean * d * power * power;
    constexpr double fold = 1e-6;
    d -= std::abs(slope) > fold ? (d - 2.0 * lean * power - straight) / slope : 0.0;
  }
  return d;
}

/// 1/(1 + j d)
Complex peak(double d) {
  const double power = 1.0 / (1.0 + d * d);
  return {power, -d * power};
}

Complex clamped_S(const Circuit& circuit, double frequency_Hz) {
  return two_pi * frequency_Hz * circuit.clamped_capacitance_F * Complex(circuit.loss_tangent, 1.0);
}

Complex behind_lead_S(const Circuit& circuit, double frequency_Hz) {
  Complex sum = clamped_S(circuit, frequency_Hz);
  double lean = circuit.lean;
  for (const Mode& mode : circuit.modes) {
    const double straight = detuning(mode, frequency_Hz);
    sum += mode.conductance_S * peak(lean == 0.0 ? straight : leaning_detuning(straight, lean));
    lean = 0.0;  // of the first alone
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
  return std::polar(1.0, rotation_rad) * behind_S /
         (1.0 + lead.impedance_ohm(frequency_Hz) * behind_S);
}

Complex Circuit::share_behind_lead(double frequency_Hz) const {
  const Complex divider =
      1.0 + lead.impedance_ohm(frequency_Hz) * behind_lead_S(*this, frequency_Hz);
  return std::polar(1.0, rotation_rad) / (divider * divider);
}

double Circuit::antiresonance_Hz() const {
  return modes.front().resonance_Hz *
         std::sqrt(1.0 + modes.front().capacitance_F() / clamped_capacitance_F);
}

double Circuit::coupling() const {
  const double motional_F = modes.front().capacitance_F();
  return std::sqrt(motional_F / (clamped_capacitance_F + motional_F));
}

double& element(Circuit& circuit, Part part) {
  switch (part) {
    case Part::loss_tangent:
      return circuit.loss_tangent;
    case Part::rotation:
      return circuit.rotation_rad;
    case Part::lead_resistance:
      return circuit.lead.resistance_ohm;
    case Part::lead_inductance:
      return circuit.lead.inductance_H;
    default:
      return circuit.lean;
  }
}

const char* name_of(Part part) {
  constexpr const char* names[part_count] = {"loss_tangent", "phase_rotation_rad",
                                             "lead_resistance_ohm", "lead_inductance_H",
                                             "lean_bandwidths"};
  return names[static_cast<std::size_t>(part)];
}

Parts Parts::with(Part part, bool is_fitted) const {
  Parts changed = *this;
  changed.fitted[static_cast<std::size_t>(part)] = is_fitted;
  return changed;
}

Eigen::Index Parts::index(Part part) const {
  Eigen::Index at = 1;
  for (std::size_t i = 0; i < static_cast<std::size_t>(part); ++i) {
    at += fitted[i] ? 1 : 0;
  }
  return at;
}

Eigen::VectorXd to_vector(const Circuit& circuit, const Parts& parts) {
  Eigen::VectorXd p(parts.size());
  Circuit copy = circuit;
  p(0) = std::log(circuit.clamped_capacitance_F);
  Eigen::Index at = 1;
  for (std::size_t i = 0; i < part_count; ++i) {
    if (parts.fitted[i]) {
      p(at++) = element(copy, static_cast<Part>(i));
    }
  }
  for (const Mode& mode : circuit.modes) {
    p.segment<3>(at) << std::log(mode.conductance_S), std::log(mode.resonance_Hz),
        std::log(mode.bandwidth_Hz);
    at += 3;
  }
  return p;
}

Circuit to_circuit(const Eigen::VectorXd& p, const Parts& parts) {
  Circuit circuit{std::exp(p(0)), 0.0, {}};
  Eigen::Index at = 1;
  for (std::size_t i = 0; i < part_count; ++i) {
    if (parts.fitted[i]) {
      element(circuit, static_cast<Part>(i)) = p(at++);
    }
  }
  for (int i = 0; i < parts.modes; ++i, at += 3) {
    circuit.modes.push_back({std::exp(p(at)), std::exp(p(at + 1)), std::exp(p(at + 2))});
  }
  return circuit;
}

Complex admittance_S(const Circuit& circuit, const Parts& parts, double frequency_Hz,
                     Eigen::VectorXcd& derivatives) {
  constexpr Complex j(0.0, 1.0);
  Complex sum = clamped_S(circuit, frequency_Hz);
  derivatives.setZero();
  derivatives(0) = sum;
  if (parts.has(Part::loss_tangent)) {
    derivatives(parts.index(Part::loss_tangent)) =
        two_pi * frequency_Hz * circuit.clamped_capacitance_F;
  }
  Eigen::Index at = parts.first_mode();
  for (std::size_t i = 0; i < circuit.modes.size(); ++i) {
    const Mode& mode = circuit.modes[i];
    const double straight = detuning(mode, frequency_Hz);
    const double lean = i == 0 ? circuit.lean : 0.0;
    const double d = lean == 0.0 ? straight : leaning_detuning(straight, lean);
    const double power = 1.0 / (1.0 + d * d);  // |i/i_max|²
    const double bent = 1.0 + 4.0 * lean * d * power * power;
    const Complex y = mode.conductance_S * peak(d);
    const Complex slope = -j * y * peak(d) / bent;  // dy/d(straight)
    derivatives(at++) = y;
    derivatives(at++) =
        slope * (-2.0 * mode.resonance_Hz * mode.resonance_Hz / (frequency_Hz * mode.bandwidth_Hz));
    derivatives(at++) = slope * -straight;
    if (i == 0 && parts.has(Part::lean)) {
      derivatives(parts.index(Part::lean)) = slope * (2.0 * power);
    }
    sum += y;
  }
  const Complex rotated = std::polar(1.0, circuit.rotation_rad);
  const Complex divider = 1.0 + circuit.lead.impedance_ohm(frequency_Hz) * sum;
  const Complex y = sum / divider;
  derivatives *= rotated / (divider * divider);
  if (parts.has(Part::rotation)) {
    derivatives(parts.index(Part::rotation)) = j * rotated * y;
  }
  if (parts.has(Part::lead_resistance)) {
    derivatives(parts.index(Part::lead_resistance)) = -rotated * y * y;
  }
  if (parts.has(Part::lead_inductance)) {
    derivatives(parts.index(Part::lead_inductance)) = -j * rotated * two_pi * frequency_Hz * y * y;
  }
  return rotated * y;
}

}  // namespace sonoglide::identify::impedance
