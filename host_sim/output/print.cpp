#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "host_sim/output/chart.hpp"
#include "host_sim/output/gnuplot.hpp"

namespace sonoglide::output {
namespace {

/// Viridis at nine places. Source: Smith and van der Walt, the default colour map of Matplotlib 2.
constexpr const char* viridis =
    "set palette defined (0 '#440154', 1 '#472d7b', 2 '#3b528b', 3 '#2c728e', 4 '#21918c', "
    "5 '#28ae80', 6 '#5ec962', 7 '#addc30', 8 '#fde725')\n";

const std::vector<double>& abscissae(const Chart& chart, const Curve& curve) {
  return curve.x.empty() ? chart.x : curve.x;
}

std::string style(const Curve& curve) {
  Pen pen = curve.pen;
  pen.colour = pen.colour.empty() ? "#000000" : pen.colour;
  if (curve.line == Line::area) {
    return fmt::format("filledcurves closed fs transparent solid 0.3 noborder lc rgb '{}'",
                       pen.colour);
  }
  if (curve.line == Line::band) {
    return fmt::format("filledcurves fs transparent solid 0.2 noborder lc rgb '{}'", pen.colour);
  }
  if (curve.line == Line::bar) {
    return fmt::format("histograms lc rgb '{}'", pen.colour);
  }
  const char* kind = pen.symbol == 0 ? "lines" : "linespoints";
  if (curve.line == Line::dots) {
    kind = "points";
  } else if (curve.line == Line::full_height) {
    kind = "impulses";
  } else if (!curve.half_width.empty()) {
    kind = "yerrorbars";
  }
  const std::string symbol =
      pen.symbol == 0 ? "" : fmt::format(" pt {} ps {}", pen.symbol, pen.size);
  const std::string every = pen.every == 1 ? "" : fmt::format(" pi {}", pen.every);
  return fmt::format("{}{}{} lw {} dt {} lc rgb '{}'", kind, symbol, every, pen.width, pen.dash,
                     pen.colour);
}

/// Gnuplot takes no block without a line.
std::string block(const std::string& name, const std::string& lines) {
  return data_block(name, lines.empty() ? "NaN NaN NaN NaN NaN NaN NaN\n" : lines);
}

std::string data(const Chart& chart, const Curve& curve, const std::string& name) {
  const std::vector<double>& x = abscissae(chart, curve);
  std::string lines;
  for (std::size_t i = 0; i < curve.y.size(); ++i) {
    const bool gap = !std::isfinite(curve.y[i]);
    if (gap && curve.line == Line::bridged) {
      continue;
    }
    if (gap || curve.half_width.empty()) {
      lines += data_point(x[i], curve.y[i]);
    } else {
      lines += fmt::format("{:.9g} {:.9g} {:.9g}\n", x[i], curve.y[i], curve.half_width[i]);
    }
  }
  return block(name, lines);
}

std::string data(const Tiles& tiles, const std::string& name) {
  std::string lines;
  for (const Tile& each : tiles.all) {
    // Gnuplot scales the colours by the boxes whose middle is within the axes.
    lines += fmt::format("{} {} {} {} {} {} {}\n", 0.5 * (each.x.low + each.x.high),
                         0.5 * (each.y.low + each.y.high), each.x.low, each.x.high, each.y.low,
                         each.y.high, each.value);
  }
  return block(name, lines);
}

std::string end_text(double end) {
  return std::isnan(end) ? "*" : fmt::format("{:.12g}", end);
}

std::string words(std::string_view text, bool verbatim) {
  return quoted(text) + (verbatim ? " noenhanced" : "");
}

/// The command that sets a title or the label of an axis, if there is one.
std::string label(const std::string& what, std::string_view text, bool verbatim) {
  return text.empty() ? fmt::format("unset {}\n", what)
                      : fmt::format("set {} {}\n", what, words(text, verbatim));
}

/// Its label, scale, numbers and range.
/// @param values  of all curves along it
std::string commands(const Axis& axis, char letter, const std::vector<double>& values) {
  const Scale scale = axis.logarithmic ? Scale::logarithmic : Scale::linear;
  std::string text = label(letter + std::string("label"), axis.label, axis.verbatim) +
                     fmt::format("{1}set logscale {0}\nset format {0} '{2}'\n", letter,
                                 axis.logarithmic ? "" : "un", axis.format);
  std::string ticks;
  for (const Tick& each : axis.ticks) {
    ticks += fmt::format("{}{} {}", ticks.empty() ? "" : ", ", quoted(std::string_view(each.name)),
                         each.at);
  }
  if (!ticks.empty()) {
    text += fmt::format("set {}tics {} ({})\n", letter, axis.verbatim ? "noenhanced" : "enhanced",
                        ticks);
  }
  const auto [low, high] = axis.span;
  return text + (std::isnan(low) && std::isnan(high)
                     ? range_command(letter, values, scale, axis.about)
                     : fmt::format("set {}range [{}:{}]\n", letter, end_text(low), end_text(high)));
}

std::string marks(const Chart& chart) {
  std::string text = "unset label\n";
  for (const Mark& mark : chart.marks) {
    text += fmt::format(
        "set label {} at {:.9g},{:.9g} offset 0,0.5 rotate by 90 font ',11' point pt 7 ps 0.3\n",
        quoted(std::string_view(mark.text)), mark.x, mark.y);
  }
  return text;
}

std::string place(const Chart& chart) {
  return chart.place
             ? fmt::format("set origin {:.4f},{:.4f}\nset size {:.4f},{:.4f}\n", chart.place->left,
                           chart.place->bottom, chart.place->width, chart.place->height)
             : std::string();
}

std::string plots(const Chart& chart, const std::string& prefix) {
  std::string text;
  const auto add = [&text](const std::string& plot) {
    text += (text.empty() ? "plot " : ", ") + plot;
  };
  for (std::size_t i = 0; i < chart.tiles.size(); ++i) {
    const Tiles& tiles = chart.tiles[i];
    const bool by_value = tiles.colour.empty();
    const std::string title =
        tiles.label.empty() ? "notitle" : "title " + words(tiles.label, false);
    const std::string fill =
        fmt::format("fs solid noborder fc {} {}",
                    by_value ? "palette" : fmt::format("rgb '{}'", tiles.colour), title);
    add(tiles.all.empty() ? "keyentry with boxes " + fill
                          : fmt::format("${}t{} using 1:2:3:4:5:6{} with boxxyerror {}", prefix, i,
                                        by_value ? ":7" : "", fill));
  }
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const Curve& curve = chart.curves[i];
    const std::string source = fmt::format(
        "${}c{} using {}{}{}", prefix, i, curve.line == Line::bar ? "2" : "1:2",
        curve.half_width.empty() ? "" : ":3", curve.line == Line::full_height ? " axes x1y2" : "");
    add(fmt::format(
        "{} with {} {}", curve.y.empty() ? "keyentry" : source, style(curve),
        curve.label.empty() ? "notitle" : "title " + words(curve.label, curve.verbatim)));
  }
  // Gnuplot takes no plot of key entries alone.
  const bool any = std::any_of(chart.curves.begin(), chart.curves.end(),
                               [](const Curve& curve) { return !curve.y.empty(); }) ||
                   std::any_of(chart.tiles.begin(), chart.tiles.end(),
                               [](const Tiles& tiles) { return !tiles.all.empty(); });
  if (!any) {
    add("NaN notitle");
  }
  return text + '\n';
}

std::string script(const Chart& chart, const std::string& prefix) {
  std::string text;
  std::vector<double> x;
  std::vector<double> y;
  for (std::size_t i = 0; i < chart.tiles.size(); ++i) {
    text += data(chart.tiles[i], fmt::format("{}t{}", prefix, i));
  }
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const Curve& curve = chart.curves[i];
    text += data(chart, curve, fmt::format("{}c{}", prefix, i));
    x.insert(x.end(), abscissae(chart, curve).begin(), abscissae(chart, curve).end());
    if (curve.line != Line::full_height) {
      y.insert(y.end(), curve.y.begin(), curve.y.end());
    }
  }
  return text + place(chart) + label("title", chart.title, chart.verbatim) +
         commands(chart.x_axis, 'x', x) + commands(chart.y_axis, 'y', y) + marks(chart) +
         chart.look + plots(chart, prefix);
}

}  // namespace

std::string print(const Sheet& sheet) {
  const auto count = static_cast<int>(sheet.charts.size());
  std::string text = std::string("set y2range [0:1]\n") + viridis + sheet.look;
  if (sheet.columns > 0) {
    text += fmt::format(
        "set multiplot layout {},{}{}\n", (count + sheet.columns - 1) / sheet.columns,
        sheet.columns,
        sheet.title.empty() ? "" : " title " + words(sheet.title, true) + " font ',15'");
  }
  for (int i = 0; i < count; ++i) {
    text += script(sheet.charts[static_cast<std::size_t>(i)], fmt::format("p{}", i));
  }
  return draw_svg(text + (sheet.columns > 0 ? "unset multiplot\n" : ""), sheet.width_px,
                  sheet.height_px);
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) {
    value *= factor;
  }
  return values;
}

}  // namespace sonoglide::output
