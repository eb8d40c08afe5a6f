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

}  // namespace

double Mode::inductance_H() const {
  return resistance_ohm() / (two_pi * bandwidth_Hz);
}

double Mode::capacitance_F() const {
  return 1.0 / (two_pi * two_pi * resonance_Hz * resonance_Hz * inductance_H());
}

Complex Circuit::admittance_S(double frequency_Hz, Eigen::VectorXcd* derivatives) const {
  constexpr Complex j(0.0, 1.0);
  const double omega = two_pi * frequency_Hz;
  Complex sum = omega * clamped_capacitance_F * Complex(loss_tangent, 1.0);
  if (derivatives != nullptr) {
    derivatives->setZero(first_mode + 3 * static_cast<Eigen::Index>(modes.size()));
    (*derivatives)(0) = sum;
    (*derivatives)(index_of(Part::loss_tangent)) = omega * clamped_capacitance_F;
  }
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const Mode& mode = modes[i];
    const double straight = detuning(mode, frequency_Hz);
    const double s = i == 0 ? lean : 0.0;
    const double d = s == 0.0 ? straight : leaning_detuning(straight, s);
    const double power = 1.0 / (1.0 + d * d);  // |i/i_max|²
    const Complex peak(power, -d * power);     // 1/(1 + j d)
    sum += mode.conductance_S * peak;
    if (derivatives != nullptr) {
      const Complex y = mode.conductance_S * peak;
      const Complex slope = -j * y * peak / (1.0 + 4.0 * s * d * power * power);  // dy/d(straight)
      const double per_resonance =
          -2.0 * mode.resonance_Hz * mode.resonance_Hz / (frequency_Hz * mode.bandwidth_Hz);
      derivatives->segment<3>(first_mode + 3 * static_cast<Eigen::Index>(i)) << y,
          slope * per_resonance, slope * -straight;
      (*derivatives)(index_of(Part::lean)) += i == 0 ? slope * (2.0 * power) : 0.0;
    }
  }
  const Complex rotated = std::polar(1.0, rotation_rad + omega * delay_s);
  const Complex divider = 1.0 + Complex(lead.resistance_ohm, omega * lead.inductance_H) * sum;
  const Complex y = sum / divider;
  if (derivatives != nullptr) {
    *derivatives *= rotated / (divider * divider);
    (*derivatives)(index_of(Part::rotation)) = j * rotated * y;
    (*derivatives)(index_of(Part::delay)) = j * omega * rotated * y;
    (*derivatives)(index_of(Part::lead_resistance)) = -rotated * y * y;
    (*derivatives)(index_of(Part::lead_inductance)) = -j * omega * rotated * y * y;
  }
  return rotated * y;
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
    case Part::delay:
      return circuit.delay_s;
    case Part::lead_resistance:
      return circuit.lead.resistance_ohm;
    case Part::lead_inductance:
      return circuit.lead.inductance_H;
    default:
      return circuit.lean;
  }
}

const char* name_of(Part part) {
  constexpr const char* names[part_count] = {"loss_tangent",      "phase_rotation_rad",
                                             "channel_delay_s",   "lead_resistance_ohm",
                                             "lead_inductance_H", "lean_bandwidths"};
  return names[static_cast<std::size_t>(part)];
}

Parts Parts::with(Part part, bool is_fitted) const {
  Parts changed = *this;
  changed.fitted[static_cast<std::size_t>(part)] = is_fitted;
  return changed;
}

std::vector<Eigen::Index> Parts::indices() const {
  std::vector<Eigen::Index> all = {0};
  for (std::size_t i = 0; i < part_count; ++i) {
    if (fitted[i]) {
      all.push_back(index_of(static_cast<Part>(i)));
    }
  }
  for (Eigen::Index i = 0; i < 3 * static_cast<Eigen::Index>(modes); ++i) {
    all.push_back(first_mode + i);
  }
  return all;
}

Eigen::VectorXd to_vector(const Circuit& circuit) {
  Eigen::VectorXd p(first_mode + 3 * static_cast<Eigen::Index>(circuit.modes.size()));
  p.head<first_mode>() << std::log(circuit.clamped_capacitance_F), circuit.loss_tangent,
      circuit.rotation_rad, circuit.delay_s, circuit.lead.resistance_ohm, circuit.lead.inductance_H,
      circuit.lean;
  Eigen::Index at = first_mode;
  for (const Mode& mode : circuit.modes) {
    p.segment<3>(at) << std::log(mode.conductance_S), std::log(mode.resonance_Hz),
        std::log(mode.bandwidth_Hz);
    at += 3;
  }
  return p;
}

Circuit to_circuit(const Eigen::VectorXd& p) {
  Circuit circuit{std::exp(p(0)), 0.0, {}};
  for (std::size_t i = 0; i < part_count; ++i) {
    const auto part = static_cast<Part>(i);
    element(circuit, part) = p(index_of(part));
  }
  for (Eigen::Index at = first_mode; at < p.size(); at += 3) {
    circuit.modes.push_back({std::exp(p(at)), std::exp(p(at + 1)), std::exp(p(at + 2))});
  }
  return circuit;
}

}  // namespace sonoglide::identify::impedance
