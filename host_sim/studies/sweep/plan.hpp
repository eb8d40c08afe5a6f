/// What a sweep computes: a scene, and how each of its points differs from it.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/long_work/pace.hpp"
#include "host_sim/long_work/work.hpp"
#include "host_sim/scene/scene.hpp"
#include "host_sim/scene_file/document.hpp"
#include "host_sim/scene_file/scene_error.hpp"
#include "host_sim/scene_file/source.hpp"
#include "host_sim/scene_file/variant.hpp"

namespace sonoglide::sweep {

// One varied key of a sweep and the values it takes.

// Powers of ten and their logarithm with the same bits on every machine. The C library's differ in
// the last bit from one processor to another.

/// 10^x, exact for whole x as far as a double is; 0 and infinity beyond its range.
/// Relative error <= 1e-15 where the result is normal.
double power_of_ten(double x);

/// log10(x), x > 0 and normal; exact for powers of ten. Error <= 4e-16 (1 + |log10(x)|).
double logarithm_to_ten(double x);

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

using long_work::PointRange;

/// The scene file is read once: a later edit of it does not reach into a sweep under way.
class Plan {
 public:
  /// @param overrides  `TABLE.KEY=VALUE` each, for every point
  /// @param vary       `KEY=FROM:TO:COUNT[:log]` or `KEY=A,B,...` each, see parse_axis()
  /// @param most       points
  /// @throws scene_file::SceneError  a bad option, a key both varied and set, an unusable first
  ///         point, where words are varied, a key that is of no use with any of them
  Plan(scene_file::Source source, std::vector<std::string> overrides, std::vector<std::string> vary,
       std::size_t most = most_points);

  const scene_file::Source& source() const { return source_; }
  const std::vector<std::string>& overrides() const { return overrides_; }
  const std::vector<std::string>& vary() const { return vary_; }

  const Grid& grid() const { return grid_; }
  PointRange all() const { return {0, grid_.size()}; }
  /// The scene of the first point, as it is stated.
  const scene::Scene& first() const { return first_; }
  bool closed_loop() const { return first_.controller.has_value(); }

  /// The points that take each combination of the varied words once, with the first of all numbers.
  std::vector<std::size_t> wordings() const;

  /// What is run at a point, the same as `run` takes it with a --set for each varied key; nothing is
  /// recorded. Where words are varied, a key that the point's words have no use for is left out.
  /// Safe to call from several threads.
  /// @throws scene_file::SceneError  at the place of the --vary option or in the scene; the message
  ///         ends with the point
  experiment::Experiment experiment(std::size_t point) const;

  /// Takes what is run at a point; called by several threads.
  using Visit = std::function<void(std::size_t point, const experiment::Experiment& experiment)>;

  /// Reads what is run at these points, on all threads.
  /// @param pace  its stage is the reading; may be null
  /// @throws scene_file::SceneError  the error of the first unusable point
  void visit(const PointRange& points, const Visit& visit, long_work::Pace* pace = nullptr) const;

  /// `KEY=VALUE, KEY=VALUE`, in the order of the axes.
  std::string describe(std::size_t point) const;

 private:
  std::vector<std::string> varied_keys() const;
  std::vector<scene_file::VariedValue> values_of(std::size_t point) const;
  experiment::Experiment read(std::size_t point) const;
  experiment::Experiment read(std::size_t point, scene_file::UnusedKeys* unused) const;
  double velocity_m_per_s(const scene::Scene& plant, std::size_t point, std::size_t axis) const;
  void require_varied_once() const;
  void require_used() const;
  [[noreturn]] void fail_at_point(const scene_file::SceneError& error, std::size_t point) const;

  scene_file::Source source_;
  std::vector<std::string> overrides_;
  std::vector<std::string> vary_;
  Grid grid_;
  bool has_words_ = false;
  std::optional<scene_file::Document> document_;  ///< from the constructor on
  scene::Scene first_;
};

}  // namespace sonoglide::sweep
