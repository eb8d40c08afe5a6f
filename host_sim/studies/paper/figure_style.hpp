/// The look of the paper's figures: line charts side by side, legible in print.
#pragma once

#include <string>
#include <vector>

#include "host_sim/output/chart.hpp"

namespace sonoglide::paper {

struct Column {
  std::string name;  ///< with its unit
  std::vector<double> values;
};

/// Numbers with 17 digits; `nan` below the end of a shorter column.
std::string to_csv(const std::vector<Column>& columns);

/// marked: a line with its colour's own symbol on it, so that it is told from others in grey as
/// well. area: inside of a closed outline, filled.
enum class Style { solid, marked, dashed, points, area };

/// The colour of what belongs to no curve, or to all.
inline constexpr int black = 0;

/// @param label   empty: not in the key
/// @param y       none: in the key alone
/// @param colour  curves of one colour belong together, and have one symbol
output::Curve curve(std::string label, std::vector<double> x, std::vector<double> y, int colour,
                    Style style = Style::solid);

/// Where the curves leave room for it; none where the chart beside it has the same.
enum class Key { above, lower_right, upper_right, upper_left, none };

/// @param labels  of the axes, with their units
/// @param y_span  absent: what the curves take
output::Chart chart(std::string title, const std::string& x_label, const std::string& y_label,
                    std::vector<output::Curve> curves, Key key = Key::above,
                    output::Span y_span = {});

/// A map from 0 to `furthest`, in points so close that a vertical end shows.
template <class Map>
output::Curve line_of(const Map& map, double furthest, int colour, std::string label = "") {
  constexpr int pieces = 1200;
  output::Curve line = curve(std::move(label), {}, {}, colour);
  for (int i = 0; i <= pieces; ++i) {
    line.x.push_back(furthest * i / pieces);
    line.y.push_back(map(line.x.back()));
  }
  return line;
}

/// One picture, two charts in a row.
output::Sheet sheet(std::vector<output::Chart> charts);

}  // namespace sonoglide::paper
