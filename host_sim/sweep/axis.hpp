/// One varied key of a sweep and the values it takes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sonoglide::sweep {

/// Not a key of a scene: ζ = Vt / v̂ of the point's own plant and drive; it sets
/// sliding.velocity_m_per_s.
inline constexpr std::string_view velocity_ratio_key = "velocity_ratio";

inline constexpr std::size_t most_points = 1'000'000;

struct Axis {
  std::string key;  ///< TABLE.KEY of a scene, or velocity_ratio_key
  double from = 0.0;
  double to = 0.0;
  std::size_t count = 1;     ///< >= 1; of one value `from` is `to`
  bool logarithmic = false;  ///< equal quotients instead of equal differences

  /// The value of this index, in [0, count); the ends are `from` and `to` to the bit.
  double value(std::size_t index) const;
};

/// Reads `KEY=FROM:TO:COUNT`, with `:log` after it for a logarithmic axis; FROM may exceed TO.
///
/// @param ordinal  1 for the first --vary option: the line of the errors' place
/// @throws scene::SceneError  not of that form, COUNT not in [1, most_points], a bound that is not
///         finite, a logarithmic axis whose bounds are zero or differ in sign, one value of a range
///         with two ends. Whether a scene has the key is not looked at here.
Axis parse_axis(const std::string& text, std::size_t ordinal);

/// A value as scenes and tables write it: the shortest text that reads back the same; a whole
/// number below 1e16 has no point.
std::string value_text(double value);

}  // namespace sonoglide::sweep
