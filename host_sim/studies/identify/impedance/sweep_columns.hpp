/// Which columns of a table are a sweep, by their names.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/studies/identify/measured_table.hpp"

namespace sonoglide::identify::impedance {

/// What the name of a column says.
enum class Role { none, frequency, magnitude, phase, real, imaginary };

struct NamedColumn {
  Role role = Role::none;
  bool is_admittance = false;
  bool names_its_subject = false;  ///< impedance or admittance
  bool decibel = false;
  double scale = 1.0;  ///< to Hz, ohm, S or radians
  bool has_unit = false;
  std::size_t index = 0;

  double value(double cell) const;
};

/// Reads a name: `Frequency(Hz)`, `impedance_magnitude_ohm`, `|Z| [kOhm]`, `theta-z(deg)`, `Re(Y)`,
/// `-Im(Z)`, `G (S)`. Case does not matter, but for the m and M of a unit. `S11 (dB)`, gains,
/// reflections, capacitances and decibels of what is not named have no role.
/// @param unknown_unit  the word in brackets, or the last one, that is no unit of what is named; else empty
NamedColumn read_name(const std::string& name, std::string& unknown_unit);

/// Whether a word names an element of an equivalent circuit, or its quality, that an analyser shows
/// instead of an impedance: Cp, Cs, Lp, Ls, Rp, Q, D.
bool is_equivalent_element(const std::string& word);

struct SweepColumns {
  NamedColumn frequency;
  NamedColumn first;                  ///< magnitude or real part
  std::optional<NamedColumn> second;  ///< phase or imaginary part
  bool rectangular;
  bool is_admittance;
  std::string description;

  /// To radians. A phase without a unit is in radians where no value is beyond ±3.2, else in
  /// degrees; a warning says so.
  double phase_scale(const std::vector<double>& phases, std::vector<std::string>& warnings) const;
};

/// All of these that the table has, in this order: magnitude and phase of an impedance, its parts,
/// magnitude and phase of an admittance, its parts, the magnitude of either.
/// @throws scene_file::SceneError  there is no frequency or none of these, a unit is not known, or two
///         columns are the same
std::vector<SweepColumns> find_columns(const MeasuredTable& table);

}  // namespace sonoglide::identify::impedance
