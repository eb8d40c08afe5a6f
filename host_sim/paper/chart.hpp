/// Line charts side by side, legible in print.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace sonoglide::paper {

enum class Line { solid, dashed, points };

/// Numbers beside each other; NaN leaves a gap.
struct Curve {
  std::string label;  ///< empty: not in the key
  std::vector<double> x;
  std::vector<double> y;
  int colour;  ///< curves of one colour belong together
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

struct Chart {
  std::string title;
  std::string x_label;  ///< with its unit
  std::string y_label;
  std::vector<Curve> curves;
  std::vector<Mark> marks = {};
  std::optional<Span> y_span = std::nullopt;  ///< absent: what the curves take
  bool logarithmic_y = false;
};

/// One SVG picture, `columns` charts in a row.
/// @throws process::ProcessError
std::string draw(const std::vector<Chart>& charts, int columns = 2);

}  // namespace sonoglide::paper
