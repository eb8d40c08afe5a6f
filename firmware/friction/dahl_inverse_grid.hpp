/// The grid on which the inverse Dahl map is tabulated; shared by the table's generator and reader.
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

/// Axes of the table of z = √(ρ/r − ρ): a row for each reduced Dahl number κ' = λ/ρ, λ = κ r, and a
/// column for each 1 − ρ. Along both axes z is as nearly straight as asin r. With z, r = ρ/(ρ + z²)
/// stays below 1 and needs no sine.
struct DahlInverseGrid {
  using Row = DyadicAxis<-4, 10>;
  using Column = DyadicAxis<-8, 0>;
  static constexpr int rows = Row::lines;
  static constexpr int columns = Column::lines;
  static constexpr int entry_bits = 15;  ///< fraction bits of an entry; z < 2
};

}  // namespace sonoglide::friction
