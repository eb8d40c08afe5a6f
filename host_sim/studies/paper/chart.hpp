/// Line charts side by side, legible in print.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace sonoglide::paper {

struct Column {
  std::string name;  ///< with its unit
  std::vector<double> values;
};

/// Numbers with 17 digits; `nan` below the end of a shorter column.
std::string to_csv(const std::vector<Column>& columns);

/// marked: a line with its colour's own symbol on it, so that it is told from others in grey as
/// well. area: inside of a closed outline, filled.
enum class Line { solid, marked, dashed, points, area };

/// The colour of what belongs to no curve, or to all.
inline constexpr int black = 0;

/// Numbers beside each other; NaN leaves a gap.
struct Curve {
  std::string label;  ///< empty: not in the key
  std::vector<double> x;
  std::vector<double> y;  ///< none: in the key alone
  int colour;             ///< curves of one colour belong together, and have one symbol
  Line line = Line::solid;
};

struct Mark {
  std::string text;
  double x;
  double y;
};

struct Span {
  double low;
  double high;
};

/// Where the curves leave room for it; none where the chart beside it has the same.
enum class Key { above, lower_right, upper_right, upper_left, none };

struct Chart {
  std::string title;
  std::string x_label;  ///< with its unit
  std::string y_label;
  std::vector<Curve> curves;
  std::vector<Mark> marks = {};
  std::optional<Span> y_span = std::nullopt;  ///< absent: what the curves take
  bool logarithmic_y = false;
  Key key = Key::above;
};

/// A map from 0 to `furthest`, in points so close that a vertical end shows; not in the key.
template <class Map>
Curve line_of(const Map& map, double furthest, int colour) {
  constexpr int pieces = 1200;
  Curve curve{"", {}, {}, colour};
  for (int i = 0; i <= pieces; ++i) {
    curve.x.push_back(furthest * i / pieces);
    curve.y.push_back(map(curve.x.back()));
  }
  return curve;
}

/// The values in another unit.
std::vector<double> scaled(std::vector<double> values, double factor);

/// One SVG picture, two charts in a row.
/// @throws process::ProcessError
std::string draw(const std::vector<Chart>& charts);

}  // namespace sonoglide::paper
