#include "host_sim/studies/paper/figure_style.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>

#include "host_sim/output/number.hpp"

namespace sonoglide::paper {

std::string to_csv(const std::vector<Column>& columns) {
  std::string text;
  for (const Column& column : columns) {
    text += (text.empty() ? "" : ",") + column.name;
  }
  text += '\n';
  std::size_t rows = 0;
  for (const Column& column : columns) {
    rows = std::max(rows, column.values.size());
  }
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t row = 0; row < rows; ++row) {
    const char* separator = "";
    for (const Column& column : columns) {
      const double value = row < column.values.size() ? column.values[row] : none;
      text += separator + output::csv_number(value);
      separator = ",";
    }
    text += '\n';
  }
  return text;
}

namespace {

// Two in a row fill a printed page of 178 mm: letters of 13 px are then 7.5 points high.
constexpr int chart_width_px = 440;
constexpr int chart_height_px = 350;
// One alone stands on three quarters of that width.
constexpr int single_width_px = 660;
constexpr int single_height_px = 480;

struct Look {
  const char* colour;
  int symbol;  ///< of gnuplot
};

constexpr Look looks[] = {{"#000000", 7}, {"#1f5fa8", 4},  {"#d62728", 8},
                          {"#1b9e5a", 6}, {"#b8570f", 10}, {"#7a3fa0", 12}};

const char* place(Key key) {
  switch (key) {
    case Key::lower_right:
      return "inside bottom right vertical";
    case Key::upper_right:
      return "inside top right vertical";
    case Key::upper_left:
      return "inside top left vertical";
    case Key::above:
    case Key::none:
      break;
  }
  return "tmargin center horizontal";
}

}  // namespace

output::Curve curve(std::string label, std::vector<double> x, std::vector<double> y, int colour,
                    Style style) {
  const Look& look = looks[static_cast<std::size_t>(colour) % std::size(looks)];
  output::Curve curve{
      std::move(label), std::move(y), output::Line::joined, std::move(x), {look.colour}};
  switch (style) {
    case Style::solid:
      break;
    case Style::marked:
      curve.pen = {look.colour, 1.6, 1, look.symbol, 0.7, 4};
      break;
    case Style::dashed:
      curve.pen = {look.colour, 1.6, 2};
      break;
    case Style::points:
      curve.line = output::Line::dots;
      curve.pen = {look.colour, 1.3, 1, look.symbol, 0.6};
      break;
    case Style::area:
      curve.line = output::Line::area;
      break;
  }
  return curve;
}

output::Chart chart(std::string title, const std::string& x_label, const std::string& y_label,
                    std::vector<output::Curve> curves, Key key, output::Span y_span) {
  output::Chart chart{std::move(title), "", {x_label}, {y_label}, {}, std::move(curves)};
  for (const output::Curve& each : chart.curves) {
    for (const double x : each.x) {
      chart.x_axis.span.high = std::fmax(chart.x_axis.span.high, x);
    }
  }
  chart.y_axis.format = "%h";
  chart.y_axis.span = y_span;
  chart.look = key == Key::none ? "unset key\n"
                                : fmt::format("set key {} Left reverse samplen 2.5\n", place(key));
  return chart;
}

output::Sheet sheet(std::vector<output::Chart> charts) {
  const bool single = charts.size() == 1;
  const int columns = single ? 1 : 2;
  const int rows = (static_cast<int>(charts.size()) + columns - 1) / columns;
  return {std::move(charts), single ? single_width_px : columns * chart_width_px,
          single ? single_height_px : rows * chart_height_px, columns,
          "set grid lc rgb '#d8d8d8'\nset tics out nomirror\nset rmargin 3\n"
          "set offsets graph 0, graph 0, graph 0.04, graph 0\n"};
}

}  // namespace sonoglide::paper
