/// Inverse friction-ratio map of a Dahl contact, for the controller.
#pragma once

#include <cstdint>

#include "firmware/friction/dahl_inverse_grid.hpp"
#include "firmware/friction/dahl_inverse_table.hpp"
#include "firmware/numeric/fixed_elementary.hpp"
#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::friction {

/// a·b of two split positive numbers.
template <class Scalar>
numeric::Split<Scalar> product(const numeric::Split<Scalar>& a, const numeric::Split<Scalar>& b) {
  const numeric::Split<Scalar> mantissas = numeric::split(a.mantissa * b.mantissa);
  return {mantissas.mantissa, mantissas.exponent + a.exponent + b.exponent};
}

/// a/b of two split positive numbers.
template <class Scalar>
numeric::Split<Scalar> quotient(const numeric::Split<Scalar>& a, const numeric::Split<Scalar>& b) {
  // A quarter of the quotient of two mantissas in [1/2, 1) lies in (1/8, 1/2).
  const Scalar quarter = a.mantissa * numeric::from_real<Scalar>(0.25);
  const numeric::Split<Scalar> mantissas = numeric::split(quarter / b.mantissa);
  return {mantissas.mantissa, mantissas.exponent + 2 + a.exponent - b.exponent};
}

namespace dahl_inverse_map_detail {

using Grid = DahlInverseGrid;

/// A place between grid lines index and index + 1.
template <class Scalar>
struct GridPosition {
  int index;
  Scalar fraction;  ///< in [0, 1]
};

/// Eighths of x in [0, 1/2]: how many are full, and how far into the next.
template <class Scalar>
GridPosition<Scalar> eighths(Scalar x) {
  constexpr int fraction_bits = 28;  // 2^31 / 8
  const std::int32_t code = numeric::to_code(x);
  const std::int32_t remainder = code & ((std::int32_t{1} << fraction_bits) - 1);
  return {code >> fraction_bits, numeric::from_code<Scalar>(remainder * 8)};
}

/// Column of a friction ratio on base 2, in [0, 1/2].
template <class Scalar>
GridPosition<Scalar> column(Scalar half_ratio) {
  constexpr Scalar half = numeric::from_real<Scalar>(0.5);
  constexpr Scalar last_octave = numeric::from_real<Scalar>(0.5 / (1 << Grid::column_octaves));
  const Scalar half_gap = half - half_ratio;  // (1 − ρ)/2
  if (half_gap < last_octave) {
    const Scalar gap = numeric::scale_by_power_of_two(half_gap, Grid::column_octaves + 1);
    return {Grid::columns - 2, numeric::from_code<Scalar>(INT32_MAX) - gap};
  }
  const numeric::Split<Scalar> gap = numeric::split(half_gap);
  GridPosition<Scalar> position = eighths(half + (half - gap.mantissa));
  position.index -= Grid::cells_per_octave * (gap.exponent + 1);  // (1 − ρ)/2 below 1/2: −1
  return position;
}

/// Row of a reduced Dahl number; clamped at the upper end, where the map is Coulomb's.
template <class Scalar>
GridPosition<Scalar> row(const numeric::Split<Scalar>& dahl_number) {
  const int octave = dahl_number.exponent - 1;
  if (octave < Grid::first_octave) {
    return {0, numeric::scale_by_power_of_two(dahl_number.mantissa,
                                              dahl_number.exponent - Grid::first_octave)};
  }
  if (octave >= Grid::end_octave) {
    return {Grid::rows - 2, numeric::from_code<Scalar>(INT32_MAX)};
  }
  GridPosition<Scalar> position = eighths(dahl_number.mantissa - numeric::from_real<Scalar>(0.5));
  position.index += 1 + (octave - Grid::first_octave) * Grid::cells_per_octave;
  return position;
}

template <class Scalar>
Scalar between(std::uint16_t begin, std::uint16_t end, Scalar fraction) {
  constexpr int to_q31 = 15;  // entries are in 2^-16
  const Scalar value = numeric::from_code<Scalar>(std::int32_t{begin} << to_q31);
  const std::int32_t rise = (std::int32_t{end} - std::int32_t{begin}) * (1 << to_q31);
  return value + fraction * numeric::from_code<Scalar>(rise);
}

/// g = u/ρ by bilinear interpolation.
template <class Scalar>
Scalar interpolate(const GridPosition<Scalar>& row, const GridPosition<Scalar>& column) {
  const std::uint16_t* const lower = &dahl_inverse_table[row.index][column.index];
  const std::uint16_t* const upper = lower + Grid::columns;
  const Scalar at_lower = between(lower[0], lower[1], column.fraction);
  const Scalar at_upper = between(upper[0], upper[1], column.fraction);
  return at_lower + row.fraction * (at_upper - at_lower);
}

}  // namespace dahl_inverse_map_detail

/// Velocity ratio r = Vt/v̂ at which a Dahl contact under sinusoidal vibration has the given
/// friction ratio.
///
/// The vibration amplitude being what is looked for, the contact is given by λ = Kt·Vt/(ω·Fc),
/// the Dahl number times r, which does not depend on it. r = sin(π u/2), u = ρ·g(ρ, λ/ρ), g from a
/// table (DahlInverseGrid, 3944 bytes).
///
/// @param half_ratio  ρ on base 2, in [0, 1/2].
/// @param lambda      λ as mantissa and exponent, > 0.
/// @return r in [0, 1]; rises with ρ; 0 for ρ = 0.
/// Error: the map at the returned r differs from ρ by at most 0.002 for Dahl numbers λ/r in
/// [0.01, 1000], in float64, float32 and Q31 alike (tested over velocity ratios 0 to 2).
template <class Scalar>
Scalar dahl_velocity_ratio(Scalar half_ratio, const numeric::Split<Scalar>& lambda) {
  using namespace dahl_inverse_map_detail;
  if (!(Scalar{} < half_ratio)) {
    return Scalar{};
  }
  numeric::Split<Scalar> reduced = quotient(lambda, numeric::split(half_ratio));
  --reduced.exponent;  // ρ is twice half_ratio
  const Scalar g = interpolate(row(reduced), column(half_ratio));
  return numeric::sin_pi(half_ratio * g);
}

}  // namespace sonoglide::friction
