/// The equivalent circuit of a transducer: a lossy clamped capacitance beside series branches of
/// resistance, inductance and capacitance, a branch a mode (Butterworth–Van Dyke), behind the
/// resistance and inductance of the leads.
#pragma once

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace sonoglide::identify::impedance {

inline constexpr double two_pi = 6.283185307179586;

/// G/(1 + j (f² − fs²)/(f Δ)): a branch by what is seen of it.
struct Mode {
  double conductance_S;  ///< largest, G = 1/R
  double resonance_Hz;   ///< fs = 1/(2π√(L C))
  double bandwidth_Hz;   ///< Δ = R/(2π L)

  double resistance_ohm() const { return 1.0 / conductance_S; }
  double inductance_H() const;
  double capacitance_F() const;
  double quality() const { return resonance_Hz / bandwidth_Hz; }
};

/// In series with all the rest: leads, contacts, electrodes.
struct Lead {
  double resistance_ohm = 0.0;
  double inductance_H = 0.0;

  std::complex<double> impedance_ohm(double frequency_Hz) const;
};

struct Circuit {
  double clamped_capacitance_F;
  double loss_tangent;      ///< of the clamped capacitance; 0 where the circuit has none
  std::vector<Mode> modes;  ///< the first is the one that is identified
  Lead lead = {};

  /// Of all, at the terminals.
  std::complex<double> admittance_S(double frequency_Hz) const;
  /// By how much a small change of the admittance behind the lead shows at the terminals:
  /// 1/(1 + Z Y')², Z the lead and Y' the admittance behind it; 1 without a lead.
  std::complex<double> share_behind_lead(double frequency_Hz) const;
  /// fs √(1 + C1/C0)
  double antiresonance_Hz() const;
  /// √(C1/(C0 + C1))
  double coupling() const;
};

/// The unit of the lead's inductance in the vector.
inline constexpr double microhenry_H = 1e-6;

enum class LeadModel { none, resistance, inductance, resistance_and_inductance };

inline bool has_resistance(LeadModel lead) {
  return lead == LeadModel::resistance || lead == LeadModel::resistance_and_inductance;
}
inline bool has_inductance(LeadModel lead) {
  return lead == LeadModel::inductance || lead == LeadModel::resistance_and_inductance;
}

/// Which parts of a circuit are fitted.
struct Parts {
  bool loss_tangent;
  int modes;
  LeadModel lead = LeadModel::none;
};

/// A circuit as a vector: ln C0, tan δ where it is fitted, resistance (ohm) and inductance (µH) of
/// the lead where they are fitted, then ln G, ln fs and ln Δ of each mode.
Eigen::VectorXd to_vector(const Circuit& circuit, Parts parts);
Circuit to_circuit(const Eigen::VectorXd& p, Parts parts);
/// Of the lead's resistance in the vector, where it is fitted.
inline Eigen::Index first_of_lead(Parts parts) {
  return parts.loss_tangent ? 2 : 1;
}
/// Of the lead's inductance in the vector, where it is fitted.
inline Eigen::Index inductance_of_lead(Parts parts) {
  return first_of_lead(parts) + (has_resistance(parts.lead) ? 1 : 0);
}
/// Of the first mode's ln G in the vector.
inline Eigen::Index first_mode(Parts parts) {
  return inductance_of_lead(parts) + (has_inductance(parts.lead) ? 1 : 0);
}
inline Eigen::Index parameters(Parts parts) {
  return first_mode(parts) + 3 * parts.modes;
}

/// The admittance, and its derivatives to the vector's elements.
std::complex<double> admittance_S(const Circuit& circuit, Parts parts, double frequency_Hz,
                                  Eigen::VectorXcd& derivatives);

}  // namespace sonoglide::identify::impedance
