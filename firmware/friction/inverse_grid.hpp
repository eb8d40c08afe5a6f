/// The grid on which inverse friction-ratio maps are tabulated; shared by what makes and what reads a
/// table.
#pragma once

namespace sonoglide::friction {

/// Grid lines at 0 and from 2^first_octave to 2^end_octave, four to an octave. The exponent and the
/// leading bits of a number give its position.
template <int FirstOctave, int EndOctave>
struct DyadicAxis {
  static constexpr int first_octave = FirstOctave;
  static constexpr int end_octave = EndOctave;
  static constexpr int cells_per_octave = 4;
  static constexpr int lines = 2 + (end_octave - first_octave) * cells_per_octave;
};

/// Axes of a table: a row for each reduced travel λ/ρ, λ in proportion to the sliding speed, and a column
/// for each 1 − ρ. An entry is a z, the root of a vibration velocity.
///
/// Of Dahl's table z = √(ρ/r − ρ) and λ = κ r: along both axes z is as nearly straight as asin r. With z,
/// r = ρ/(ρ + z²) stays below 1 and needs no sine. Of the other laws see InverseForm.
struct InverseGrid {
  using Row = DyadicAxis<-4, 10>;
  using Column = DyadicAxis<-8, 0>;
  static constexpr int rows = Row::lines;
  static constexpr int columns = Column::lines;
  static constexpr int entry_bits = 15;  ///< fraction bits of an entry; z < 2
};

}  // namespace sonoglide::friction
