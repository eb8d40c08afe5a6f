/// Inverse friction-ratio maps that are tabulated, for the controller.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "firmware/friction/inverse_grid.hpp"
#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/float_format.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/word.hpp"

namespace sonoglide::friction {

/// A row beside a row.
using InverseTable = std::array<std::array<std::uint16_t, InverseGrid::columns>, InverseGrid::rows>;

namespace inverse_table_detail {

using Grid = InverseGrid;

/// A place between grid lines index and index + 1.
struct GridPosition {
  int index;
  std::int32_t fraction;  ///< in [0, 1), with 31 fraction bits
};

/// Position of x >= 0 on an axis, clamped at the upper end. The bits of a floating-point number above
/// 0 are in order, and their leading ones tell the grid line.
template <class Axis, class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
GridPosition position(Float x) {
  using Format = numeric::FloatFormat<Float>;
  using Bits = numeric::FloatBits<Float>;
  constexpr int quarter_bits = Format::fraction_bits - 2;
  constexpr Bits begin = numeric::to_bits(numeric::power_of_two<Float>(Axis::first_octave));
  constexpr Bits end = numeric::to_bits(numeric::power_of_two<Float>(Axis::end_octave));
  const Bits bits = numeric::to_bits(x);
  if (!numeric::likely(bits - begin < end - begin)) {
    return bits < begin
               ? GridPosition{0, static_cast<std::int32_t>(
                                     x * numeric::power_of_two<Float>(31 - Axis::first_octave))}
               : GridPosition{Axis::lines - 2, INT32_MAX};
  }
  // All that is above the rest is shifted out.
  constexpr int above_rest = std::numeric_limits<Bits>::digits - quarter_bits;
  const auto rest = static_cast<Bits>(bits << above_rest) >> 1;
  return {1 + static_cast<int>((bits - begin) >> quarter_bits),
          static_cast<std::int32_t>(rest >> (std::numeric_limits<Bits>::digits - 32))};
}

template <class Axis, class Storage, int Bits, class Overflow>
GridPosition position(const numeric::Split<numeric::Fixed<Storage, Bits, Overflow>>& x) {
  constexpr int quarter_bits = Bits - 3;
  const std::int32_t raw = x.mantissa.raw();
  const int octave = x.exponent - 1 - Axis::first_octave;
  if (octave < 0) {
    return {0, octave > -32 ? (raw << (31 - Bits)) >> (-1 - octave) : 0};
  }
  if (x.exponent > Axis::end_octave) {
    return {Axis::lines - 2, INT32_MAX};
  }
  const auto rest = static_cast<std::uint32_t>(raw) << (32 - quarter_bits) >> 1;
  // The leading bit of the mantissa stands for one octave.
  return {1 + (octave - 1) * Axis::cells_per_octave + (raw >> quarter_bits),
          static_cast<std::int32_t>(rest)};
}

/// Half of z between two entries, with 31 fraction bits; rounded down.
inline std::int32_t between(std::uint16_t begin, std::uint16_t end, std::int32_t fraction) {
  constexpr int bits = 30 - Grid::entry_bits;
  const std::int32_t rise = std::int32_t{end} - begin;
  std::int32_t more = 0;
  if constexpr (numeric::has_wide_product) {
    more = numeric::high_word(rise * (1 << (bits + 1)), fraction);
  } else {
    // The same from two products that fit a word.
    more = rise * (fraction >> 16) + ((rise * (fraction & 0xffff)) >> 16);
  }
  return (std::int32_t{begin} << bits) + more;
}

inline const std::uint16_t* entry(const std::uint16_t (&table)[Grid::rows][Grid::columns], int row,
                                  int column) {
  return &table[row][column];
}
inline const std::uint16_t* entry(const InverseTable& table, int row, int column) {
  return table[static_cast<std::size_t>(row)].data() + column;
}

/// Half of z by bilinear interpolation, with 31 fraction bits.
template <class Table>
std::int32_t interpolate(const Table& table, const GridPosition& row, const GridPosition& column) {
  const std::uint16_t* const lower = entry(table, row.index, column.index);
  const std::uint16_t* const upper = lower + Grid::columns;
  const std::int32_t at_lower = between(lower[0], lower[1], column.fraction);
  const std::int32_t at_upper = between(upper[0], upper[1], column.fraction);
  return at_lower + 2 * numeric::high_word(at_upper - at_lower, row.fraction);
}

/// x², x with 31 fraction bits.
template <class Scalar>
Scalar square(std::int32_t x) {
  if constexpr (numeric::is_fixed_point_v<Scalar>) {
    return numeric::from_code<Scalar>(2 * numeric::high_word(x, x));
  } else {
    const auto real = numeric::from_code<Scalar>(x);
    return real * real;
  }
}

/// Column of 1 - ρ, for ρ on base 2 in (0, 1/2]. A larger one is at the end, in every format.
template <class Scalar>
GridPosition column(Scalar half_ratio) {
  const Scalar half_gap = numeric::from_real<Scalar>(0.5) - half_ratio;
  if constexpr (numeric::is_fixed_point_v<Scalar>) {
    if (!(Scalar{} < half_gap)) {
      return half_gap < Scalar{} ? GridPosition{Grid::Column::lines - 2, INT32_MAX}
                                 : GridPosition{0, 0};
    }
    numeric::Split<Scalar> gap = numeric::split_positive(half_gap);
    ++gap.exponent;
    return position<Grid::Column>(gap);
  } else {
    return position<Grid::Column>(half_gap + half_gap);
  }
}

/// min(x + 2 a b, largest value), for x, a and b of at least 0.
template <class Float, std::enable_if_t<std::is_floating_point_v<Float>, int> = 0>
Float limited_sum(Float x, Float a, Float b) {
  const Float sum = x + (a + a) * b;
  constexpr auto largest = numeric::from_code<Float>(INT32_MAX);
  return numeric::likely(numeric::is_below(sum, largest)) ? sum : numeric::min(largest, sum);
}

template <class Overflow>
numeric::Q31<Overflow> limited_sum(numeric::Q31<Overflow> x,
                                   const numeric::Split<numeric::Q31<Overflow>>& a,
                                   numeric::Q31<Overflow> b) {
  using Scalar = numeric::Q31<Overflow>;
  const Scalar product = numeric::half_product(a.mantissa, b);
  const int up = a.exponent + 2;
  const std::int32_t more = up < 0 ? product.raw() >> numeric::min(-up, 31)
                                   : numeric::lifted(product, numeric::min(up, 31)).raw();
  std::int32_t sum = 0;
  return __builtin_add_overflow(x.raw(), more, &sum) ? Scalar::largest() : Scalar::from_raw(sum);
}

template <class Overflow>
numeric::Q15<Overflow> limited_sum(numeric::Q15<Overflow> x,
                                   const numeric::Split<numeric::Q15<Overflow>>& a,
                                   numeric::Q15<Overflow> b) {
  const std::int32_t room = INT16_MAX - x.raw();
  const std::int32_t product = std::int32_t{a.mantissa.raw()} * b.raw();
  const int down = 14 - a.exponent;
  std::int32_t more = product > 0 ? room : 0;
  if (down >= 0) {
    more = down < 31 ? product >> down : 0;
  }
  return numeric::Q15<Overflow>::from_raw(
      static_cast<std::int16_t>(x.raw() + numeric::min(more, room)));
}

}  // namespace inverse_table_detail

/// How the z of a table tells a vibration velocity.
enum class InverseForm : std::uint8_t {
  beyond_sliding,  ///< v̂ = Vt + reach·(Vt/ρ)·z²: no less than the sliding lowers the friction
  over_ratio,      ///< v̂ = reach·(Vt/ρ)·z²
  plain,           ///< v̂ = reach·Vt·z², at the table's end for every ρ below 2^-9
};

/// Peak vibration velocity v̂ at which a contact that slides at Vt has the given friction ratio, by a
/// table of any law: z from the table against λ/ρ and ρ. It takes one division and no sine, as that of
/// Dahl does.
///
/// @param half_ratio   ρ on base 2, at most 1/2.
/// @param speed        Vt, > 0, on the base of the result.
/// @param half_travel  λ/(2 Vt), > 0.
/// @param reach        > 0.
/// @param form         of the table
/// @param table        see InverseTable; entries below 2^15
/// @return v̂ at most 1 (fixed point: the largest value); 1 for ρ <= 0 but in the plain form.
template <class Scalar>
Scalar tabulated_vibration_velocity(Scalar half_ratio, Scalar speed,
                                    const numeric::Floating<Scalar>& half_travel,
                                    const numeric::Floating<Scalar>& reach, InverseForm form,
                                    const InverseTable& table) {
  using namespace inverse_table_detail;
  constexpr Scalar least = numeric::from_real<Scalar>(0x1p-10);
  half_ratio = form == InverseForm::plain ? numeric::max(half_ratio, least) : half_ratio;
  if (!(Scalar{} < half_ratio)) {
    return numeric::from_code<Scalar>(INT32_MAX);
  }
  const numeric::Floating<Scalar> sliding = numeric::floating_positive(speed);
  const numeric::Floating<Scalar> stretched =
      numeric::quotient(sliding, numeric::floating_positive(half_ratio));
  const GridPosition row = position<Grid::Row>(numeric::product(half_travel, stretched));
  const Scalar begin = form == InverseForm::beyond_sliding ? speed : Scalar{};
  const numeric::Floating<Scalar> unit =
      form == InverseForm::plain ? numeric::rescaled(sliding, 1) : stretched;
  return limited_sum(begin, numeric::product(reach, unit),
                     square<Scalar>(interpolate(table, row, column(half_ratio))));
}

}  // namespace sonoglide::friction
