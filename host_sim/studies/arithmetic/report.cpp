#include "host_sim/studies/arithmetic/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "firmware/control/interface/names.hpp"
#include "host_sim/output/chart.hpp"
#include "host_sim/output/number.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene_file/echo.hpp"

namespace sonoglide::arithmetic {
namespace {

constexpr int csv_digits = 6;

std::string fields(const Precision& precision) {
  return output::csv_cells({precision.rms_difference, precision.largest_difference,
                            precision.steady_error, precision.ripple},
                           csv_digits);
}

std::string fields(const std::optional<loop::ImageInstructions>& instructions) {
  return instructions ? fmt::format("{},{},{}", instructions->step.min,
                                    output::csv_number(instructions->step.mean, csv_digits),
                                    instructions->step.max)
                      : std::string("nan,nan,nan");
}

}  // namespace

std::string images_csv(const ArithmeticComparison& comparison) {
  std::string csv =
      "board,core,arithmetic,rms_difference,largest_difference,steady_error,ripple,fault,"
      "instructions_min,instructions_mean,instructions_max,flash_bytes,ram_bytes\n";
  for (const ImageRow& row : comparison.images) {
    csv += fmt::format("{},{},{},{},{},{},{},{}\n", row.board->name, row.board->core,
                       scene::name_of(scene::arithmetics, row.arithmetic), fields(row.precision),
                       control::name(row.fault), fields(row.image.instructions),
                       row.image.memory->flash_bytes, row.image.memory->ram_bytes);
  }
  return csv;
}

std::string targets_csv(const ArithmeticComparison& comparison) {
  std::string csv =
      "target,arithmetic,rms_difference,largest_difference,steady_error,ripple,limit,fault\n";
  for (const TargetRow& row : comparison.targets) {
    csv += fmt::format("{:.2f},{},{},{},{}\n", row.target,
                       scene::name_of(scene::arithmetics, row.arithmetic), fields(row.precision),
                       control::name(row.limit), control::name(row.fault));
  }
  return csv;
}

namespace {

std::string_view name(scene::Arithmetic arithmetic) {
  return scene::name_of(scene::arithmetics, arithmetic);
}

std::string number(double value) {
  return output::formatted(value, "{:.1e}");
}

std::string instructions(const std::optional<loop::ImageInstructions>& count) {
  return count ? fmt::format("{}/{:.0f}/{}", count->step.min, count->step.mean, count->step.max)
               : std::string("-");
}

std::string line(const ImageRow& row) {
  const std::string fault =
      row.fault == control::Fault::none ? "" : fmt::format("  FAULT: {}", control::name(row.fault));
  return fmt::format("{:11} {:8} {:>8} {:>8} {:>8} {:>8} {:>17} {:>7}{}\n", row.board->core,
                     scene::name_of(scene::arithmetics, row.arithmetic),
                     number(row.precision.rms_difference), number(row.precision.largest_difference),
                     number(row.precision.steady_error), number(row.precision.ripple),
                     instructions(row.image.instructions), row.image.memory->flash_bytes, fault);
}

std::string text(const ArithmeticComparison& comparison) {
  std::string lines = fmt::format("{:11} {:8} {:>8} {:>8} {:>8} {:>8} {:>17} {:>7}\n", "core", "",
                                  "rms", "largest", "error", "ripple", "instructions", "flash");
  for (const ImageRow& row : comparison.images) {
    lines += line(row);
  }
  return lines +
         "rms, largest: difference of the friction ratio from float64's; instructions of a step: "
         "min/mean/max\n";
}

output::Table image_table(const ArithmeticComparison& comparison) {
  output::Table table{
      "Images",
      {"Core", "Arithmetic", "rms difference", "Largest difference", "Steady error", "Ripple",
       "Instructions, least", "mean", "most", "Flash [bytes]", "RAM [bytes]", "Fault"},
      {}};
  for (const ImageRow& row : comparison.images) {
    const auto& count = row.image.instructions;
    table.rows.push_back(
        {std::string(row.board->core), std::string(name(row.arithmetic)),
         number(row.precision.rms_difference), number(row.precision.largest_difference),
         number(row.precision.steady_error), number(row.precision.ripple),
         count ? fmt::format("{}", count->step.min) : "-",
         count ? fmt::format("{:.0f}", count->step.mean) : "-",
         count ? fmt::format("{}", count->step.max) : "-",
         fmt::format("{}", row.image.memory->flash_bytes),
         fmt::format("{}", row.image.memory->ram_bytes), std::string(control::name(row.fault))});
  }
  return table;
}

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

double drawn(double difference) {
  return std::max(difference, smallest_difference);
}

/// Difference over instructions, a line for each arithmetic and a symbol for each board.
output::Chart images_panel(const ArithmeticComparison& comparison) {
  const std::vector<const emulated::EmulatedBoard*> boards = boards_of(comparison);
  output::Chart chart{"",
                      "",
                      {"Instructions per control step, mean [-]", true, {}, "%g", 1e3},
                      {"Friction ratio, rms difference from float64 [-]",
                       true,
                       {0.3 * smallest_difference, 1.0},
                       "10^{%T}"},
                      {},
                      {}};
  for (const scene::Arithmetic arithmetic : all_arithmetics) {
    output::Curve line{std::string(name(arithmetic)),
                       {},
                       output::Line::joined,
                       {},
                       {colour_of(arithmetic), 2.0, 3}};
    std::vector<output::Curve> symbols;
    for (std::size_t i = 0; i < boards.size(); ++i) {
      for (const ImageRow& row : comparison.images) {
        if (row.board == boards[i] && row.arithmetic == arithmetic && row.image.instructions) {
          line.x.push_back(row.image.instructions->step.mean);
          line.y.push_back(drawn(row.precision.rms_difference));
          symbols.push_back({"",
                             {line.y.back()},
                             output::Line::dots,
                             {line.x.back()},
                             {colour_of(arithmetic), 2.0, 1, marker_of(i), 1.2}});
        }
      }
    }
    if (!symbols.empty()) {
      chart.curves.push_back(std::move(line));
    }
    chart.curves.insert(chart.curves.end(), symbols.begin(), symbols.end());
  }
  for (std::size_t i = 0; i < boards.size(); ++i) {
    chart.curves.push_back({fmt::format("{} ({})", boards[i]->core, boards[i]->name),
                            {},
                            output::Line::dots,
                            {},
                            {"#606060", 1.0, 1, marker_of(i), 1.2}});
  }
  chart.place = {0.0, 0.0, 0.52, 0.93};
  chart.look = fmt::format(
      "set ytics add ('0' {:g})\nset offsets graph 0.08, graph 0.08, graph 0, graph 0\n"
      "set key top right Left reverse samplen 2\n",
      smallest_difference);
  return chart;
}

/// A figure of the targets' precision; none of float64 where that is the reference.
output::Chart targets_panel(const ArithmeticComparison& comparison, const output::Place& place,
                            const char* x_label, const char* y_label, bool difference) {
  output::Chart chart{"",
                      "",
                      {x_label, false, {0.0, 1.0}, "%g"},
                      {y_label, true, {}, "10^{%T}", smallest_difference},
                      {},
                      {}};
  for (const scene::Arithmetic arithmetic : all_arithmetics) {
    if (difference && arithmetic == scene::Arithmetic::float64) {
      continue;
    }
    output::Curve& curve = chart.curves.emplace_back();
    curve.line = output::Line::bridged;
    curve.pen = {colour_of(arithmetic), 1.0, 1, 7, 0.4};
    for (const TargetRow& row : comparison.targets) {
      if (row.arithmetic == arithmetic) {
        curve.x.push_back(row.target);
        curve.y.push_back(difference ? drawn(row.precision.rms_difference) : row.precision.ripple);
      }
    }
  }
  chart.place = place;
  chart.look = "set lmargin 11\nunset offsets\nunset key\nset ytics auto\n";
  return chart;
}

}  // namespace

output::Sheet diagrams(const scene::Scene& scene, const ArithmeticComparison& comparison) {
  const bool of_force = scene.controller->holds_force();
  return {{images_panel(comparison),
           targets_panel(comparison, {0.52, 0.47, 0.48, 0.46}, "",
                         "rms difference from float64 [-]", true),
           targets_panel(
               comparison, {0.52, 0.0, 0.48, 0.47},
               of_force ? "Target force over the friction [-]" : "Target friction ratio [-]",
               of_force ? "Ripple of the force over the friction [-]" : "Ripple of the ratio [-]",
               false)},
          1120,
          620,
          2,
          "set tics nomirror\nset border 3\nset grid xtics ytics lc rgb '#d8d8d8' lw 1\n",
          scene.name + ", the controller in every arithmetic"};
}

output::Page page(const scene::Scene& scene, const ArithmeticComparison& comparison) {
  std::vector<output::Chart> charts = diagrams(scene, comparison).charts;
  constexpr std::array<const char*, 3> titles = {
      "What an image costs and loses", "Difference from float64 by target", "Ripple by target"};
  for (std::size_t i = 0; i < charts.size(); ++i) {
    charts[i].title = titles.at(i);
    charts[i].x_axis.label = charts[i == 1 ? 2 : i].x_axis.label;
    charts[i].group = i == 0 ? "" : "target";
    for (std::size_t k = 0; i > 0 && k < charts[i].curves.size(); ++k) {
      charts[i].curves[k].label = name(all_arithmetics.at(k));
    }
  }
  charts.front().note = "Lower and further left is better: a point for each board.";
  return {"Arithmetics of " + scene.name,
          "The controller of the scene in each arithmetic: what it loses against float64 in the "
          "same closed loop, and what a step costs on each board.",
          {},
          {},
          {{"Cost and accuracy", "", std::move(charts), {image_table(comparison)}}},
          scene_file::to_json(scene)};
}

output::StudyReport report(const scene::Scene& scene, const ArithmeticComparison& comparison) {
  return {{{"arithmetic.csv", images_csv(comparison)},
           {"targets.csv", targets_csv(comparison)},
           {"arithmetic.svg", output::print(diagrams(scene, comparison))},
           {"report.html", output::to_html(page(scene, comparison))}},
          text(comparison)};
}

}  // namespace sonoglide::arithmetic
