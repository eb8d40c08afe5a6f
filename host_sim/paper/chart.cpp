#include "host_sim/paper/chart.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <iterator>

#include "host_sim/plot/gnuplot.hpp"

namespace sonoglide::paper {
namespace {

constexpr int chart_width_px = 560;
constexpr int chart_height_px = 430;
constexpr const char* colours[] = {"#1f5fa8", "#d62728", "#1b9e5a", "#b8570f", "#7a3fa0"};

const char* colour(const Curve& curve) {
  return colours[static_cast<std::size_t>(curve.colour) % std::size(colours)];
}

const char* style(Line line) {
  switch (line) {
    case Line::solid:
      return "with lines lw 2.2";
    case Line::dashed:
      return "with lines dt 2 lw 2";
    case Line::points:
      break;
  }
  return "with points pt 6 ps 0.6 lw 1.5";
}

/// A block of data; a blank line is a gap.
std::string data(const Curve& curve, std::size_t index) {
  std::string text = fmt::format("$c{} << EOD\n", index);
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (std::isfinite(curve.y[i])) {
      fmt::format_to(std::back_inserter(text), "{:.9g} {:.9g}\n", curve.x[i], curve.y[i]);
    } else {
      text += '\n';
    }
  }
  return text + "EOD\n";
}

std::string key_entry(const Curve& curve) {
  return curve.label.empty() ? "notitle" : fmt::format("title \"{}\"", curve.label);
}

std::string marks(const Chart& chart) {
  std::string text = "unset label\n";
  for (const Mark& mark : chart.marks) {
    text += fmt::format(
        "set label \"{}\" at {:.9g},{:.9g} offset 0,0.5 rotate by 90 font ',10' point pt 7 ps "
        "0.3\n",
        mark.text, mark.x, mark.y);
  }
  return text;
}

std::string script(const Chart& chart) {
  std::string text;
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    text += data(chart.curves[i], i);
  }
  text += marks(chart);
  text += fmt::format("set title \"{}\"\nset xlabel \"{}\"\nset ylabel \"{}\"\nunset logscale\n",
                      chart.title, chart.x_label, chart.y_label);
  text +=
      chart.logarithmic_y ? "set logscale y\nset format y '10^{{%L}}'\n" : "set format y '%h'\n";
  text += chart.y_span
              ? fmt::format("set yrange [{:.9g}:{:.9g}]\n", chart.y_span->low, chart.y_span->high)
              : "set yrange [*:*]\n";
  const char* separator = "plot ";
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    text +=
        fmt::format("{}$c{} using 1:2 {} lc rgb '{}' {}", separator, i, style(chart.curves[i].line),
                    colour(chart.curves[i]), key_entry(chart.curves[i]));
    separator = ", ";
  }
  return text + '\n';
}

}  // namespace

std::string draw(const std::vector<Chart>& charts, int columns) {
  const int rows = (static_cast<int>(charts.size()) + columns - 1) / columns;
  std::string text = fmt::format(
      "set multiplot layout {},{}\nset autoscale xfixmax\nset grid lc rgb '#d8d8d8'\nset tics out "
      "nomirror\n"
      "set key tmargin center horizontal samplen 2.5\nset rmargin 3\n",
      rows, columns);
  for (const Chart& chart : charts) {
    text += script(chart);
  }
  return plot::draw_svg(text + "unset multiplot\n", columns * chart_width_px,
                        rows * chart_height_px);
}

}  // namespace sonoglide::paper
