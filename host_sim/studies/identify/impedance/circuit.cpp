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
/// higher frequencies follows.
double leaning_detuning(double straight, double lean) {
  const auto excess = [&](double d) { return d - 2.0 * lean / (1.0 + d * d) - straight; };
  double low = straight + std::min(0.0, 2.0 * lean);
  double high = straight + std::max(0.0, 2.0 * lean);
  constexpr double most_of_one_solution = 0.76;
  if (std::abs(lean) > most_of_one_solution) {
    constexpr int parts = 24;
    const double step = (high - low) / parts;
    for (int i = 1; i < parts && excess(low + step) < 0.0; ++i) {
      low += step;
    }
    high = low + step;
  }
  double d = 0.5 * (low + high);
  constexpr int most_steps = 60;
  for (int i = 0; i < most_steps; ++i) {
    const double off = excess(d);
    (off < 0.0 ? low : high) = d;
    const double square = 1.0 + d * d;
    double next = d - off / (1.0 + 4.0 * lean * d / (square * square));
    if (!(next > low && next < high)) {
      next = 0.5 * (low + high);
    }
    if (std::abs(next - d) <= 1e-15 * (1.0 + std::abs(d))) {
      return next;
    }
    d = next;
  }
  return d;
}

Complex clamped_S(const Circuit& circuit, double frequency_Hz) {
  return two_pi * frequency_Hz * circuit.clamped_capacitance_F * Complex(circuit.loss_tangent, 1.0);
}

Complex behind_lead_S(const Circuit& circuit, double frequency_Hz) {
  Complex sum = clamped_S(circuit, frequency_Hz);
  double lean = circuit.lean;
  for (const Mode& mode : circuit.modes) {
    const double straight = detuning(mode, frequency_Hz);
    sum += mode.conductance_S /
           Complex(1.0, lean == 0.0 ? straight : leaning_detuning(straight, lean));
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
  for (std::size_t i = 0; i < circuit.modes.size(); ++i) {
    const Mode& mode = circuit.modes[i];
    p.segment<2>(at) << std::log(mode.conductance_S), std::log(mode.resonance_Hz);
    at += 2;
    if (i < static_cast<std::size_t>(parts.modes)) {
      p(at++) = std::log(mode.bandwidth_Hz);
    }
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
  for (int i = 0; i < parts.beside; ++i, at += 2) {
    const double resonance_Hz = std::exp(p(at + 1));
    circuit.modes.push_back(
        {std::exp(p(at)), resonance_Hz, resonance_Hz / circuit.modes.front().quality()});
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
  const Eigen::Index first = parts.first_mode();
  Eigen::Index at = first;
  for (std::size_t i = 0; i < circuit.modes.size(); ++i) {
    const Mode& mode = circuit.modes[i];
    const double straight = detuning(mode, frequency_Hz);
    const double lean = i == 0 ? circuit.lean : 0.0;
    const double d = lean == 0.0 ? straight : leaning_detuning(straight, lean);
    const double power = 1.0 / (1.0 + d * d);  // |i/i_max|²
    const double bent = 1.0 + 4.0 * lean * d * power * power;
    const Complex y = mode.conductance_S / Complex(1.0, d);
    const Complex slope = -j * y * y / (mode.conductance_S * bent);  // dy/d(straight)
    const Complex by_bandwidth = slope * -straight;
    derivatives(at++) = y;
    derivatives(at++) =
        slope * (-2.0 * mode.resonance_Hz * mode.resonance_Hz / (frequency_Hz * mode.bandwidth_Hz));
    if (i < static_cast<std::size_t>(parts.modes)) {
      derivatives(at++) = by_bandwidth;
    } else {  // ln Δ = ln fs − ln(fs/Δ) of the first
      derivatives(at - 1) += by_bandwidth;
      derivatives(first + 1) -= by_bandwidth;
      derivatives(first + 2) += by_bandwidth;
    }
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
