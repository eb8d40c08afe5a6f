/// One varied key of a sweep and the values it takes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/scene_file/variant.hpp"

namespace sonoglide::sweep {

/// Not a key of a scene: ζ = Vt / v̂ of the point's own plant and drive; it sets
/// sliding.velocity_m_per_s.
inline constexpr std::string_view velocity_ratio_key = "velocity_ratio";

/// Of a sweep in one piece, which holds all its rows.
inline constexpr std::size_t most_points = 1'000'000;
/// Of a sweep in shards, and of one axis.
inline constexpr std::size_t most_points_in_shards = 1'000'000'000'000;

/// A value that is named, not one of a range.
struct ListedValue {
  std::string text;              ///< as tables write it
  std::optional<double> number;  ///< absent: a word or a truth value
  scene_file::VariedValue value;
};

struct Axis {
  std::string key;  ///< TABLE.KEY of a scene, or velocity_ratio_key
  double from = 0.0;
  double to = 0.0;
  std::size_t count = 1;            ///< >= 1; of one value `from` is `to`
  bool logarithmic = false;         ///< equal quotients instead of equal differences
  std::vector<ListedValue> list{};  ///< `count` values in place of a range; empty: the range

  /// The number of this index, in [0, count); the ends of a range are `from` and `to` to the bit.
  /// NaN for what is listed and no number.
  double number(std::size_t index) const;
  /// As a scene takes it.
  scene_file::VariedValue value(std::size_t index) const;
  /// As tables and messages write it.
  std::string text(std::size_t index) const;

  /// Whether there is a value that is no number.
  bool has_words() const;
  /// Whether a picture sets the values side by side instead of on a scale: words, and numbers that
  /// neither rise nor fall all along.
  bool categorical() const;
  /// Where a picture draws a value: its number, or 1, 2, 3 … side by side.
  double position(std::size_t index) const;
};

/// Reads `KEY=FROM:TO:COUNT`, with `:log` after it for a logarithmic axis; FROM may exceed TO. Or
/// `KEY=A,B,C`: words, truth values and numbers, each as `--set` takes it.
///
/// @param ordinal  1 for the first --vary option: the line of the errors' place
/// @throws scene_file::SceneError  not of either form, COUNT not in [1, most_points_in_shards], a bound that
///         is not finite, a logarithmic axis whose bounds are zero or differ in sign, one value of
///         a range with two ends, a value that is listed twice. Whether a scene has the key is not
///         looked at here.
Axis parse_axis(const std::string& text, std::size_t ordinal);

/// A number as scenes and tables write it: the shortest text that reads back the same; a whole
/// number below 1e16 has no point.
std::string number_text(double value);

/// Cartesian product; the first axis changes slowest.
class Grid {
 public:
  /// @param most  points, at most most_points_in_shards
  /// @throws scene_file::SceneError  no axis, or more points
  explicit Grid(std::vector<Axis> axes, std::size_t most = most_points);

  const std::vector<Axis>& axes() const { return axes_; }
  std::size_t size() const { return size_; }

  /// Points from one value of an axis to the next.
  std::size_t stride(std::size_t axis) const { return strides_[axis]; }
  /// Position along an axis of a point, in [0, count of that axis).
  std::size_t index(std::size_t point, std::size_t axis) const {
    return point / strides_[axis] % axes_[axis].count;
  }
  double number(std::size_t point, std::size_t axis) const {
    return axes_[axis].number(index(point, axis));
  }
  std::string text(std::size_t point, std::size_t axis) const {
    return axes_[axis].text(index(point, axis));
  }

 private:
  std::vector<Axis> axes_;
  std::vector<std::size_t> strides_;
  std::size_t size_ = 1;
};

}  // namespace sonoglide::sweep
