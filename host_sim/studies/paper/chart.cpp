#include "host_sim/studies/paper/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include "host_sim/output/gnuplot.hpp"
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

const Look& look(const Curve& curve) {
  return looks[static_cast<std::size_t>(curve.colour) % std::size(looks)];
}

std::string style(const Curve& curve) {
  const int symbol = look(curve).symbol;
  switch (curve.line) {
    case Line::solid:
      return "with lines lw 2";
    case Line::marked:
      return fmt::format("with linespoints pt {} pi 4 ps 0.7 lw 1.6", symbol);
    case Line::dashed:
      return "with lines dt 2 lw 1.6";
    case Line::points:
      return fmt::format("with points pt {} ps 0.6 lw 1.3", symbol);
    case Line::area:
      break;
  }
  return "with filledcurves closed fs transparent solid 0.3 noborder";
}

std::string data(const Curve& curve, std::size_t index) {
  std::string lines;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    lines += output::data_point(curve.x[i], curve.y[i]);
  }
  return output::data_block(fmt::format("c{}", index), lines);
}

std::string source(const Curve& curve, std::size_t index) {
  return curve.y.empty() ? "keyentry" : fmt::format("$c{} using 1:2", index);
}

std::string key_entry(const Curve& curve) {
  return curve.label.empty() ? "notitle" : fmt::format("title \"{}\"", curve.label);
}

std::string marks(const Chart& chart) {
  std::string text = "unset label\n";
  for (const Mark& mark : chart.marks) {
    text += fmt::format(
        "set label \"{}\" at {:.9g},{:.9g} offset 0,0.5 rotate by 90 font ',11' point pt 7 ps "
        "0.3\n",
        mark.text, mark.x, mark.y);
  }
  return text;
}

std::string key_place(Key key) {
  const char* place = "tmargin center horizontal";
  switch (key) {
    case Key::none:
      return "unset key\n";
    case Key::lower_right:
      place = "inside bottom right vertical";
      break;
    case Key::upper_right:
      place = "inside top right vertical";
      break;
    case Key::upper_left:
      place = "inside top left vertical";
      break;
    case Key::above:
      break;
  }
  return fmt::format("set key {} Left reverse samplen 2.5\n", place);
}

std::vector<double> ordinates(const Chart& chart) {
  std::vector<double> all;
  for (const Curve& curve : chart.curves) {
    all.insert(all.end(), curve.y.begin(), curve.y.end());
  }
  return all;
}

std::string script(const Chart& chart) {
  std::string text;
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    text += data(chart.curves[i], i);
  }
  text += marks(chart) + key_place(chart.key);
  text += fmt::format("set title \"{}\"\nset xlabel \"{}\"\nset ylabel \"{}\"\nunset logscale\n",
                      chart.title, chart.x_label, chart.y_label);
  text +=
      chart.logarithmic_y ? "set logscale y\nset format y '10^{{%L}}'\n" : "set format y '%h'\n";
  text += chart.y_span
              ? fmt::format("set yrange [{:.9g}:{:.9g}]\n", chart.y_span->low, chart.y_span->high)
              : output::range_command(
                    'y', ordinates(chart),
                    chart.logarithmic_y ? output::Scale::logarithmic : output::Scale::linear, 1.0);
  const char* separator = "plot ";
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const Curve& curve = chart.curves[i];
    text += fmt::format("{}{} {} lc rgb '{}' {}", separator, source(curve, i), style(curve),
                        look(curve).colour, key_entry(curve));
    separator = ", ";
  }
  return text + '\n';
}

}  // namespace

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) {
    value *= factor;
  }
  return values;
}

std::string draw(const std::vector<Chart>& charts) {
  const int columns = charts.size() == 1 ? 1 : 2;
  const int rows = (static_cast<int>(charts.size()) + columns - 1) / columns;
  std::string text = fmt::format(
      "set multiplot layout {},{}\nset autoscale xfixmax\nset grid lc rgb '#d8d8d8'\nset tics out "
      "nomirror\n"
      "set rmargin 3\n"
      "set offsets graph 0, graph 0, graph 0.04, graph 0\n",
      rows, columns);
  for (const Chart& chart : charts) {
    text += script(chart);
  }
  text += "unset multiplot\n";
  return charts.size() == 1
             ? output::draw_svg(text, single_width_px, single_height_px)
             : output::draw_svg(text, columns * chart_width_px, rows * chart_height_px);
}

}  // namespace sonoglide::paper
