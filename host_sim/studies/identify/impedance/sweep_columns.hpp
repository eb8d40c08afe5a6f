/// Which columns of a table are a sweep, by their names, and its readings.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/studies/identify/impedance/sweep.hpp"
#include "host_sim/studies/identify/measured_table.hpp"

namespace sonoglide::identify::impedance {

// What the name of a column of a sweep says.

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

/// Magnitude and phase, real and imaginary part, or a magnitude alone.
struct SweepColumns {
  ColumnName first;
  std::optional<ColumnName> second;
  double reference_ohm = 1.0;  ///< of a reflection

  bool rectangular() const { return first.role == Role::real; }
  /// As in "magnitude and phase of an impedance".
  std::string description() const;
};

struct FoundColumns {
  ColumnName frequency;
  /// All that the table has of these, in this order: magnitude and phase of an impedance, its parts,
  /// magnitude and phase of an admittance, its parts, magnitudes alone. The first is the sweep.
  std::vector<SweepColumns> forms;
  std::vector<std::string> warnings;  ///< what was assumed, and which columns are not read
};

/// Whether one of the names is a frequency and another may be of an impedance or admittance.
bool are_names_of_a_sweep(const std::vector<std::string>& names);

/// @throws scene_file::SceneError  there is no frequency or none of the forms; a name of a sweep is
///         not understood whole, or two columns are the same, and no pair stands beside them; or a
///         magnitude has a phase beside it that cannot be read
FoundColumns find_columns(const MeasuredTable& table);

/// The readings in the order of the rows. A phase without a unit is in radians where none is beyond
/// ±3.2, else in degrees; a warning says so.
/// @param second_table  that of the second column, of as many rows
/// @throws scene_file::SceneError  a frequency or magnitude is not above 0, or an admittance 0 or
///         without end
Sweep sweep_of(const MeasuredTable& table, const MeasuredTable& second_table,
               const ColumnName& frequency, SweepColumns columns);

}  // namespace sonoglide::identify::impedance
