/// The grid on which the inverse Dahl map is tabulated; shared by the table's generator and reader.
#pragma once

namespace sonoglide::friction {

/// Grid lines at 0 and, four to an octave, from 2^first_octave to 2^end_octave: a position is read
/// off a number's exponent and leading bits.
template <int FirstOctave, int EndOctave>
struct DyadicAxis {
  static constexpr int first_octave = FirstOctave;
  static constexpr int end_octave = EndOctave;
  static constexpr int cells_per_octave = 4;
  static constexpr int lines = 2 + (end_octave - first_octave) * cells_per_octave;
};

/// Axes of the table of z = √(ρ/r − ρ) against reduced Dahl number κ' = λ/ρ, λ = κ r, (rows) and
/// 1 − ρ (columns). z bends as little along them as asin r does, and r = ρ/(ρ + z²) stays below 1
/// without a sine.
struct DahlInverseGrid {
  using Row = DyadicAxis<-4, 10>;
  using Column = DyadicAxis<-8, 0>;
  static constexpr int rows = Row::lines;
  static constexpr int columns = Column::lines;
  static constexpr int entry_bits = 15;  ///< fraction bits of an entry; z < 2
};

}  // namespace sonoglide::friction
