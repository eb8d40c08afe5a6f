/// What a controller knows of a natural mode that it observes in the friction alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Indices of the numbers in a row of the table.
struct SensorlessIndex {
  static constexpr std::size_t rotation = 0;      ///< d cos θ and d sin θ, of a period
  static constexpr std::size_t input_gain = 2;    ///< B: what a change of the amplitude adds
  static constexpr std::size_t forced = 4;        ///< |H|: steady velocity at full drive
  static constexpr std::size_t feedback = 5;      ///< K: on the mode and on the amplitude's error
  static constexpr std::size_t per_velocity = 8;  ///< 1/|H|
  static constexpr std::size_t bend = 9;          ///< half the square of the angle to the next row
  static constexpr std::size_t plain = 10;        ///< those of the nodes follow
  static constexpr std::size_t sloped =
      feedback;  ///< the slopes of those before this one are of use

  /// In a node, which is of a velocity ratio: 1/8, 2/8 … 1.
  struct Node {
    static constexpr std::size_t output = 0;       ///< C: what a reading shows of a mode of 1
    static constexpr std::size_t last_change = 2;  ///< the same of the last change of the amplitude
    static constexpr std::size_t change_before = 3;  ///< of the one before
    static constexpr std::size_t noise = 4;          ///< of a reading, rms
    static constexpr std::size_t count = 5;
    static constexpr std::size_t sloped = noise;  ///< likewise
  };
  static constexpr int node_bits = 3;
  static constexpr std::size_t nodes = std::size_t{1} << node_bits;
  static constexpr std::size_t count = plain + nodes * Node::count;

  /// Rows over the range of natural frequencies, equally far apart.
  static constexpr int row_bits = 3;
  static constexpr std::size_t rows = (std::size_t{1} << row_bits) + 1;
};

template <class Scalar>
using SensorlessRow = std::array<Scalar, SensorlessIndex::count>;
template <class Scalar>
using SensorlessTable = std::array<SensorlessRow<Scalar>, SensorlessIndex::rows>;

/// A table at a frequency between its rows and at a velocity ratio between its nodes, and the
/// slopes over the frequency: linear interpolation. Between two turns it would fall short of the
/// modulus, and a mode would seem to decay: so a turn is lengthened by bend x (1 - x), x the part
/// of the way to the next row. What is left of the shortfall is below the fourth power of the angle
/// between the rows. In fixed point products are too small by less than two units of the last
/// place.
template <class Scalar>
class SensorlessInterpolation {
  using Index = SensorlessIndex;

 public:
  /// @param table  stays where it is: it outlives this
  explicit SensorlessInterpolation(const SensorlessTable<Scalar>& table) : table_(&table) {}

  /// After a copy from elsewhere. @param table  an equal one, as in the constructor
  void settle_at(const SensorlessTable<Scalar>& table) { table_ = &table; }

  /// @param frequency_parameter  from -1 at the first row to 1 at the last
  void go(Scalar frequency_parameter) {
    constexpr int shift = 32 - Index::row_bits;
    const std::int32_t code = numeric::to_code(frequency_parameter);
    constexpr int middle = 1 << (Index::row_bits - 1);
    const int below = (code >> shift) + middle;
    row_ = static_cast<std::size_t>(below);
    along_ = fraction(code, Index::row_bits);
    for (std::size_t i = 0; i < Index::plain; ++i) {
      const Scalar low = (*table_)[row_][i];
      const Scalar rise = (*table_)[row_ + 1][i] - low;
      values_[i] = low + numeric::rough_product(rise, along_);
      if (i < Index::sloped) {
        slopes_[i] = slope_of(rise);
      }
    }
    constexpr Scalar whole = numeric::from_code<Scalar>(INT32_MAX);
    const Scalar longer = numeric::rough_product(values_[Index::bend],
                                                 numeric::rough_product(along_, whole - along_));
    for (std::size_t i = 0; i < 2; ++i) {
      values_[Index::rotation + i] = values_[Index::rotation + i] +
                                     numeric::rough_product(values_[Index::rotation + i], longer);
    }
  }

  /// @param ratio  velocity ratio; below 1/8 as at 1/8
  void look(Scalar ratio) {
    const std::int32_t code = numeric::to_code(ratio);
    const auto eighths = static_cast<std::size_t>(code >> (31 - Index::node_bits));
    const std::size_t node = eighths == 0 ? 0 : eighths - 1;
    const Scalar part =
        eighths == 0 ? Scalar{}
                     : fraction(code & (INT32_MAX >> Index::node_bits), Index::node_bits + 1);
    const std::size_t first = Index::plain + node * Index::Node::count;
    for (std::size_t i = 0; i < Index::Node::count; ++i) {
      const Scalar low = between((*table_)[row_], first + i, part);
      const Scalar rise = between((*table_)[row_ + 1], first + i, part) - low;
      node_values_[i] = low + numeric::rough_product(rise, along_);
      if (i < Index::Node::sloped) {
        node_slopes_[i] = slope_of(rise);
      }
    }
  }

  Scalar operator[](std::size_t i) const { return values_[i]; }
  /// Over the frequency parameter.
  Scalar slope(std::size_t i) const { return slopes_[i]; }
  /// At the velocity ratio that was looked for last.
  Scalar of_node(std::size_t i) const { return node_values_[i]; }
  Scalar slope_of_node(std::size_t i) const { return node_slopes_[i]; }

 private:
  /// What a code has below its leading bits, the sign among them.
  static Scalar fraction(std::int32_t code, int leading) {
    return numeric::from_code<Scalar>(
        static_cast<std::int32_t>((static_cast<std::uint32_t>(code) << leading) >> 1));
  }

  static Scalar between(const SensorlessRow<Scalar>& row, std::size_t i, Scalar part) {
    return row[i] + numeric::rough_product(part, row[i + Index::Node::count] - row[i]);
  }

  /// From one row to the next the frequency parameter moves by 2/8.
  static Scalar slope_of(Scalar rise) {
    constexpr int steep = Index::row_bits - 1;
    if constexpr (numeric::is_fixed_point_v<Scalar>) {
      return numeric::lifted(rise, steep);
    } else {
      return rise * numeric::power_of_two<Scalar>(steep);
    }
  }

  const SensorlessTable<Scalar>* table_;
  std::size_t row_ = 0;
  Scalar along_{};
  std::array<Scalar, Index::plain> values_{};
  std::array<Scalar, Index::sloped> slopes_{};
  std::array<Scalar, Index::Node::count> node_values_{};
  std::array<Scalar, Index::Node::sloped> node_slopes_{};
};

}  // namespace sonoglide::control
