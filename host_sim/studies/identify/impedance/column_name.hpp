/// What the name of a column of a sweep says.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sonoglide::identify::impedance {

enum class Role { none, frequency, magnitude, phase, real, imaginary };
/// A reflection is that of a Touchstone file.
enum class Subject { unknown, impedance, admittance, reflection };

struct ColumnName {
  std::size_t index = 0;   ///< of the column
  Role role = Role::none;  ///< none: not of a sweep, or not understood
  Subject subject = Subject::unknown;
  bool has_unit = false;
  bool is_bare_unit = false;  ///< the name is a unit and nothing else
  bool decibel = false;
  double scale = 1.0;  ///< to Hz, ohm, S or radians; negative where the name has a minus
  /// Of a reflection, a transmission or a gain, as S11: its phase may stand beside it.
  bool is_ratio = false;

  /// Where the name is of a sweep, and not all of it is understood: the first that is not, which
  /// may be a unit of something else. Such a name has no role.
  std::string not_understood;

  /// In Hz, ohm, S or radians.
  double value(double cell) const;
};

/// Reads a name whole: `Frequency(Hz)`, `impedance_magnitude_ohm`, `|Z| [kOhm]`, `theta-z(deg)`,
/// `Re(Y)`, `-Im(Z)`, `G (10^-6 S)`, `phasez`, `P[deg]`, `neg. phase`, `Z'' / Ohm`. Case does not
/// matter, but in units (see unit.hpp). Units may stand anywhere. Names of other quantities, as a
/// voltage, a time, S11, a gain or a capacitance, are no names of a sweep.
ColumnName read_name(std::string_view name);

}  // namespace sonoglide::identify::impedance
