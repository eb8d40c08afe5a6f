#include "host_sim/studies/arithmetic/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

#include "host_sim/output/gnuplot.hpp"
#include "host_sim/scene/names.hpp"

namespace sonoglide::arithmetic {
namespace {

constexpr int width_px = 1120;
constexpr int height_px = 620;
/// Where a difference of zero is drawn.
constexpr double smallest_difference = 1e-10;

const char* colour_of(scene::Arithmetic arithmetic) {
  switch (arithmetic) {
    case scene::Arithmetic::q15:
      return "#b8570f";
    case scene::Arithmetic::q31:
      return "#1b9e5a";
    case scene::Arithmetic::float32:
      return "#1f5fa8";
    case scene::Arithmetic::float64:
      break;
  }
  return "#111111";
}

/// Open ones: images lie close together.
int marker_of(std::size_t board) {
  static constexpr int markers[] = {6, 4, 8, 12, 10, 14, 1};
  return markers[board % 7];
}

/// Each once, in the order of the rows.
std::vector<const emulated::EmulatedBoard*> boards_of(const ArithmeticComparison& comparison) {
  std::vector<const emulated::EmulatedBoard*> boards;
  for (const ImageRow& row : comparison.images) {
    if (boards.empty() || boards.back() != row.board) {
      boards.push_back(row.board);
    }
  }
  return boards;
}

std::string_view name(scene::Arithmetic arithmetic) {
  return scene::name_of(scene::arithmetics, arithmetic);
}

double drawn(double difference) {
  return std::max(difference, smallest_difference);
}

/// "$images_q15": instructions, difference, marker of the board.
std::string image_block(const ArithmeticComparison& comparison, scene::Arithmetic arithmetic) {
  std::string lines;
  const std::vector<const emulated::EmulatedBoard*> boards = boards_of(comparison);
  for (std::size_t i = 0; i < boards.size(); ++i) {
    for (const ImageRow& row : comparison.images) {
      if (row.board == boards[i] && row.arithmetic == arithmetic && row.image.instructions) {
        lines += fmt::format("{:.6g} {:.6g} {}\n", row.image.instructions->step.mean,
                             drawn(row.precision.rms_difference), marker_of(i));
      }
    }
  }
  return output::data_block(fmt::format("images_{}", name(arithmetic)), lines);
}

/// "$targets_q15": target, difference, ripple, and no ripple where a limit disturbs.
std::string target_block(const ArithmeticComparison& comparison, scene::Arithmetic arithmetic) {
  std::string lines;
  for (const TargetRow& row : comparison.targets) {
    if (row.arithmetic == arithmetic) {
      lines += fmt::format("{} {:.6g} {:.6g}\n", row.target, drawn(row.precision.rms_difference),
                           row.precision.ripple);
    }
  }
  return output::data_block(fmt::format("targets_{}", name(arithmetic)), lines);
}

std::vector<double> instructions(const ArithmeticComparison& comparison) {
  std::vector<double> means;
  for (const ImageRow& row : comparison.images) {
    if (row.image.instructions) {
      means.push_back(row.image.instructions->step.mean);
    }
  }
  return means;
}

/// Of the targets in column 2 of their blocks, or in column 3.
std::vector<double> target_figures(const ArithmeticComparison& comparison, int column) {
  std::vector<double> all;
  for (const TargetRow& row : comparison.targets) {
    const bool shown = column != 2 || row.arithmetic != scene::Arithmetic::float64;
    all.push_back(!shown        ? 0.0
                  : column == 2 ? drawn(row.precision.rms_difference)
                                : row.precision.ripple);
  }
  return all;
}

std::string images_panel(const ArithmeticComparison& comparison) {
  std::string plots;
  for (const scene::Arithmetic arithmetic : all_arithmetics) {
    plots += fmt::format(
        "{0}$images_{1} using 1:2 with lines lc rgb '{2}' dt 3 lw 2 title '{1}', "
        "'' using 1:2:3 with points lc rgb '{2}' pt variable ps 1.2 lw 2 notitle",
        plots.empty() ? "plot " : ", \\\n", name(arithmetic), colour_of(arithmetic));
  }
  const std::vector<const emulated::EmulatedBoard*> boards = boards_of(comparison);
  for (std::size_t i = 0; i < boards.size(); ++i) {
    plots += fmt::format(", \\\nkeyentry with points lc rgb '#606060' pt {} ps 1.2 title '{} ({})'",
                         marker_of(i), boards[i]->core, boards[i]->name);
  }
  return fmt::format(
             "set size 0.52,0.93\nset origin 0,0\n"
             "set logscale xy\nset format x '%g'\nset format y '10^{{%T}}'\n"
             "set xlabel 'Instructions per control step, mean [-]'\n"
             "set ylabel 'Friction ratio, rms difference from float64 [-]'\n"
             "set yrange [{:g}:1]\nset ytics add ('0' {:g})\n{}"
             "set offsets graph 0.08, graph 0.08, graph 0, graph 0\n"
             "set key top right Left reverse samplen 2\n",
             0.3 * smallest_difference, smallest_difference,
             output::range_command('x', instructions(comparison), output::Scale::logarithmic,
                                   1e3)) +
         plots + "\n";
}

std::string targets_panel(const ArithmeticComparison& comparison, const char* placement,
                          const char* x_label, const char* y_label, int column) {
  std::string lines;
  for (const scene::Arithmetic arithmetic : all_arithmetics) {
    const bool reference = arithmetic == scene::Arithmetic::float64;
    if (reference && column == 2) {
      continue;
    }
    lines += fmt::format("{}$targets_{} using 1:{} with linespoints lc rgb '{}' pt 7 ps 0.4",
                         lines.empty() ? "plot " : ", \\\n", name(arithmetic), column,
                         colour_of(arithmetic));
  }
  return fmt::format("{}set xlabel '{}'\nset ylabel '{}'\nset xrange [0:1]\n{}set format x '%g'\n",
                     placement, x_label, y_label,
                     output::range_command('y', target_figures(comparison, column),
                                           output::Scale::logarithmic, smallest_difference)) +
         lines + "\n";
}

}  // namespace

std::string draw(const ArithmeticComparison& comparison, const std::string& title) {
  std::string script;
  for (const scene::Arithmetic arithmetic : all_arithmetics) {
    script += image_block(comparison, arithmetic) + target_block(comparison, arithmetic);
  }
  script += fmt::format(
      "set multiplot title {} noenhanced font ',15'\n"
      "set datafile missing 'nan'\n"
      "set tics nomirror\nset border 3\nset grid xtics ytics lc rgb '#d8d8d8' lw 1\n",
      output::quoted(title));
  script += images_panel(comparison);
  script +=
      "unset logscale x\nset lmargin 11\nunset offsets\nunset key\nset ytics auto\nset format y "
      "'10^{%T}'\n";
  script += targets_panel(comparison, "set size 0.48,0.46\nset origin 0.52,0.47\n", "",
                          "rms difference from float64 [-]", 2);
  script += targets_panel(comparison, "set size 0.48,0.47\nset origin 0.52,0\n",
                          "Target friction ratio [-]", "Ripple of the ratio [-]", 3);
  return output::draw_svg(script + "unset multiplot\n", width_px, height_px);
}

}  // namespace sonoglide::arithmetic
