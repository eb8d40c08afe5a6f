/// The equivalent circuit of a transducer: a lossy clamped capacitance beside series branches of
/// resistance, inductance and capacitance, a branch a mode (Butterworth–Van Dyke), behind the
/// resistance and inductance of the leads, seen by an instrument whose phase may be off by an angle and
/// by a delay between its channels.
#pragma once

#include <Eigen/Core>

#include <bitset>
#include <complex>
#include <cstddef>
#include <vector>

#include "firmware/numeric/turn.hpp"

namespace sonoglide::identify::impedance {

using numeric::two_pi;
inline constexpr double degrees_per_rad = 360.0 / two_pi;  ///< in a radian

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
};

struct Circuit {
  double clamped_capacitance_F;
  double loss_tangent;      ///< of the clamped capacitance; 0 where the circuit has none
  std::vector<Mode> modes;  ///< the first is the one that is identified
  Lead lead = {};
  double rotation_rad = 0.0;  ///< by which every phase of the admittance is read too large
  /// Of the voltage's channel behind the current's: every phase of the admittance is read too large by
  /// 2π f times it.
  double delay_s = 0.0;
  /// By how many band widths the resonance of the first mode is lower at the largest current than at
  /// a small one: f0 = fs − lean Δ |i/i_max|². Below 0 it is higher. A mode of resistance, mass and a
  /// spring that softens or stiffens with the square of the displacement (Duffing) has one.
  double lean = 0.0;

  /// At the terminals; with its derivatives to the elements of the circuit's vector.
  std::complex<double> admittance_S(double frequency_Hz,
                                    Eigen::VectorXcd* derivatives = nullptr) const;
  /// fs √(1 + C1/C0)
  double antiresonance_Hz() const;
  /// √(C1/(C0 + C1))
  double coupling() const;
};

/// What a circuit may have beside clamped capacitance and modes.
enum class Part : std::size_t {
  loss_tangent,
  rotation,
  delay,
  lead_resistance,
  lead_inductance,
  lean
};

inline constexpr std::size_t part_count = 6;

double& element(Circuit& circuit, Part part);
/// As identify.json names it.
const char* name_of(Part part);

/// Where a circuit's vector has a part, and where the elements of its modes begin.
inline constexpr Eigen::Index index_of(Part part) {
  return 1 + static_cast<Eigen::Index>(part);
}
inline constexpr Eigen::Index first_mode = 1 + static_cast<Eigen::Index>(part_count);

/// A circuit as a vector: ln C0, all parts, then ln G, ln fs and ln Δ of each mode.
Eigen::VectorXd to_vector(const Circuit& circuit);
Circuit to_circuit(const Eigen::VectorXd& p);

/// Which parts of a circuit are fitted; the others are 0.
struct Parts {
  std::bitset<part_count> fitted;
  int modes = 1;

  bool has(Part part) const { return fitted[static_cast<std::size_t>(part)]; }
  bool has_lead() const { return has(Part::lead_resistance) || has(Part::lead_inductance); }
  /// What turns the phases beside a rotation of all by one angle.
  bool has_lead_or_delay() const { return has_lead() || has(Part::delay); }
  Parts with(Part part, bool is_fitted = true) const;
  /// Of the elements of the vector that are fitted.
  std::vector<Eigen::Index> indices() const;
  Eigen::Index size() const {
    return 1 + static_cast<Eigen::Index>(fitted.count()) + 3 * static_cast<Eigen::Index>(modes);
  }
};

}  // namespace sonoglide::identify::impedance
