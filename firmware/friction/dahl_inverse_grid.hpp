/// The grid on which the inverse Dahl map is tabulated; shared by the table's generator and reader.
#pragma once

#include <cstddef>

namespace sonoglide::friction {

/// Axes of the table g = u/ρ, u = (2/π) asin r, against friction ratio ρ and reduced Dahl number
/// κ' = λ/ρ, λ = κ r.
///
/// Both axes are dyadic: octaves cut into four equal cells, so that a position is read off a
/// number's exponent and leading bits. Columns follow 1 − ρ downward from 1; rows follow κ' upward,
/// with one row at κ' = 0 below them.
struct DahlInverseGrid {
  static constexpr int cells_per_octave = 4;
  static constexpr int column_octaves = 8;  ///< 1 − ρ from 1 down to 2^−8
  static constexpr int columns = column_octaves * cells_per_octave + 2;  ///< the last is ρ = 1
  static constexpr int first_octave = -4;                                ///< κ' from 2^−4
  static constexpr int end_octave = 10;                                  ///< to 2^10
  static constexpr int rows = 1 + (end_octave - first_octave) * cells_per_octave + 1;
};

}  // namespace sonoglide::friction
