/// A chart as data, told once: print() draws it as a picture, a Page shows it to be zoomed and read.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace sonoglide::output {

/// An end left open is where the curves end.
struct Span {
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
};

/// A place on an axis with a name in place of its number.
struct Tick {
  double at;
  std::string name;
};

/// On a page a label's plain SI unit gets the prefix that suits the range on show, any other a power
/// of ten. "[-]" marks a pure number.
///
/// Printed texts have gnuplot's mark-up, in which `_` and `^` lower and raise; verbatim ones have none.
struct Axis {
  std::string label;             ///< ends with its unit in square brackets, "Displacement [m]"
  bool logarithmic = false;      ///< what is not above 0 is not drawn
  Span span = {};                ///< in print
  std::string format = "% h";    ///< of the numbers in print
  double about = 1.0;            ///< in print, where no curve has a value; > 0
  std::vector<Tick> ticks = {};  ///< in place of numbers
  bool verbatim = false;
  bool has_zero = false;       ///< on a page the axis is drawn as far as 0
  bool whole_numbers = false;  ///< on a page it is numbered by whole numbers alone
};

enum class Line {
  joined,       ///< from point to point, with a gap where y is not finite
  bridged,      ///< across the gaps too: a branch of a loop
  stepped,      ///< held until the next point, the last one as long as the one before it
  dots,         ///< a dot each
  area,         ///< the inside of a closed outline
  band,         ///< stepped, filled as far as half_width to either side
  full_height,  ///< from the bottom to the top of the chart at every x; y is 1
  bar           ///< beside those of the other curves, at x 0, 1, 2 …
};

/// How a curve is drawn: as it is in print. A page takes what it tells apart from it: curves of one
/// colour have one there too, of the page's own, which are safe for the colour-blind in light and
/// dark; black is that of letters, greys are muted.
struct Pen {
  /// Empty: black in print, on a page a colour and a dash of the curve's own.
  std::string colour = {};
  double width = 2.0;
  int dash = 1;       ///< of gnuplot: 1 none, 2 dashes, 3 dots
  int symbol = 0;     ///< of gnuplot; 0: none
  double size = 1.0;  ///< of the symbol
  int every = 1;      ///< point has a symbol
};

struct Curve {
  std::string label;  ///< in print an empty one is not in the key
  std::vector<double> y;
  Line line = Line::joined;
  std::vector<double> x = {};  ///< absent: the chart's
  Pen pen = {};
  std::vector<double> half_width = {};  ///< of an error bar at each point
  bool verbatim = false;
};

/// A point with a name, printed upright.
struct Mark {
  std::string text;
  double x;
  double y;
};

/// A rectangle of one colour. On a page an end left open is that of the chart.
struct Tile {
  Span x;
  Span y;
  double value = 0.0;
};

struct Tiles {
  std::vector<Tile> all;    ///< none: in the key alone
  std::string colour = {};  ///< empty: that of each one's value, in viridis
  std::string label = {};   ///< empty: not in the key
  bool behind = false;      ///< on a page: a faint ground
};

/// Of a sheet, in parts of it.
struct Place {
  double left;
  double bottom;
  double width;
  double height;
};

struct Chart {
  std::string title;
  std::string note;  ///< on a page: one or two sentences under the title; may be empty
  Axis x_axis;
  Axis y_axis;
  std::vector<double> x;  ///< of every curve without its own; never decreases
  std::vector<Curve> curves;
  std::string group = {};  ///< on a page charts of one non-empty group zoom and hover together
  std::vector<Mark> marks = {};
  std::vector<Tiles> tiles = {};
  std::optional<Place> place = std::nullopt;  ///< absent: the sheet's next
  std::string look = {};                      ///< further commands of gnuplot, in print
  bool verbatim = false;                      ///< the title
  bool equal_scales = false;                  ///< a unit is as long along x as along y
};

/// What is printed as one picture.
struct Sheet {
  std::vector<Chart> charts;
  int width_px;
  int height_px;
  int columns = 0;         ///< of charts; 0: one chart is the picture
  std::string look = {};   ///< commands of gnuplot for all charts
  std::string title = {};  ///< of several charts, verbatim
};

/// The same data as a file: an SVG document on a white ground, numbers with nine digits. Abscissae may be in any order.
/// @throws process::ProcessError  there is no gnuplot, or it refuses
std::string print(const Sheet& sheet);

/// As the JSON that page/chart.js draws, safe inside an HTML script element (no '<'); NaN and infinities become null.
std::string chart_json(const Chart& chart);

/// Whether the chart has a value that its axes can show.
bool has_something_to_draw(const Chart& chart);

/// The values in another unit.
std::vector<double> scaled(std::vector<double> values, double factor);

}  // namespace sonoglide::output
