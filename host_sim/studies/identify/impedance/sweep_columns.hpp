/// Which columns of a table are a sweep, by their names.
#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/studies/identify/impedance/column_name.hpp"
#include "host_sim/studies/identify/measured_table.hpp"

namespace sonoglide::identify::impedance {

struct SweepColumn {
  ColumnName name;
  std::size_t index = 0;
};

/// Magnitude and phase, real and imaginary part, or a magnitude alone.
struct SweepColumns {
  SweepColumn first;
  std::optional<SweepColumn> second;

  bool rectangular() const { return first.name.role == Role::real; }
  /// As in "magnitude and phase of an impedance".
  std::string description() const;
  /// The admittance of a row; of a magnitude alone its magnitude. Not finite or 0: it is none.
  std::complex<double> admittance_S(double first_cell, double second_cell) const;
  /// Gives a phase without a unit one: radians where no value is beyond ±3.2, else degrees.
  /// @return a sentence that says so; empty where the phase has a unit
  std::string complete_unit(const std::vector<double>& phases);
};

struct FoundColumns {
  SweepColumn frequency;
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

}  // namespace sonoglide::identify::impedance
