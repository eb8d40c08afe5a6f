#include "host_sim/studies/design/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>

#include "host_sim/output/gnuplot.hpp"

namespace sonoglide::design {
namespace {

constexpr int panel_width_px = 560;
constexpr int panel_height_px = 430;
constexpr const char* colours[] = {"#1f5fa8", "#d62728", "#1b9e5a", "#b8570f", "#7a3fa0"};
constexpr const char* beyond_limit = "#f6dcdc";

const char* colour(std::size_t index) {
  return colours[index % std::size(colours)];
}

/// With a point that is not drawn: a block must not be empty.
std::string block(const std::string& name, const std::string& lines) {
  return output::data_block(name, "NaN NaN\n" + lines);
}

std::string style() {
  return "set grid lc rgb '#d8d8d8'\nset tics out nomirror\nset border 3\nset rmargin 3\n"
         "set key outside top center horizontal samplen 2.5\n";
}

/// Shades a panel above a level.
std::string shade_above(double level) {
  return fmt::format(
      "set object 1 rectangle from graph 0, first {:.9g} to graph 1, graph 1 fc rgb '{}' fs solid "
      "noborder behind\n",
      level, beyond_limit);
}

std::string axes(const char* title, const char* x_label, const char* y_label) {
  return fmt::format("set title \"{}\"\nset xlabel \"{}\"\nset ylabel \"{}\"\n", title, x_label,
                     y_label);
}

/// "plot" of one block a ratio.
std::string curves(const std::vector<double>& ratios, const std::string& prefix,
                   const std::string& more) {
  std::string plots;
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    plots += fmt::format("{}${}{} using 1:2 with lines lw 2.2 lc rgb '{}' title 'ratio {:g}'",
                         plots.empty() ? "plot " : ", ", prefix, i, colour(i), ratios[i]);
  }
  return plots + more + '\n';
}

std::string requirement_blocks(const DesignStudy& study, const std::string& prefix,
                               const std::function<double(const Requirement&)>& figure) {
  std::string text;
  for (std::size_t i = 0; i < study.curves.size(); ++i) {
    std::string lines;
    for (const Requirement& point : study.curves[i].requirements) {
      lines += output::data_point(point.sliding_m_per_s, figure(point));
    }
    text += block(fmt::format("{}{}", prefix, i), lines);
  }
  return text;
}

std::vector<double> figures(const DesignStudy& study,
                            const std::function<double(const Requirement&)>& figure) {
  std::vector<double> all;
  for (const RatioRequirements& curve : study.curves) {
    std::transform(curve.requirements.begin(), curve.requirements.end(), std::back_inserter(all),
                   figure);
  }
  return all;
}

std::string undriven_block(const DesignStudy& study) {
  std::string lines;
  for (const Requirement& point : study.curves.front().requirements) {
    lines += output::data_point(point.sliding_m_per_s, point.motion.undriven_friction_power_W);
  }
  return block("undriven", lines);
}

std::string design_point_block(const DesignStudy& study) {
  std::string lines;
  for (const DesignPoint& point : study.points) {
    lines += output::data_point(point.requirement.sliding_m_per_s,
                                point.requirement.motion.drive_force_N);
  }
  return block("points", lines);
}

std::string detuning_blocks(const DesignStudy& study, const std::string& prefix,
                            double DetunedPoint::*figure) {
  std::string text;
  for (std::size_t i = 0; i < study.detunings.size(); ++i) {
    std::string lines;
    bool above = false;
    for (const DetunedPoint& point : study.detunings[i].points) {
      // Nothing is known at resonance itself.
      lines += !above && point.tuning > 1.0 ? "\n" : "";
      above = point.tuning > 1.0;
      lines += output::data_point(point.tuning, point.*figure);
    }
    text += block(fmt::format("{}{}", prefix, i), lines);
  }
  return text;
}

std::vector<double> figures(const DesignStudy& study, double DetunedPoint::*figure) {
  std::vector<double> all;
  for (const Detuning& detuning : study.detunings) {
    for (const DetunedPoint& point : detuning.points) {
      all.push_back(point.*figure);
    }
  }
  return all;
}

std::vector<double> ratios_of(const DesignStudy& study) {
  std::vector<double> ratios;
  ratios.reserve(study.curves.size());
  for (const RatioRequirements& curve : study.curves) {
    ratios.push_back(curve.ratio);
  }
  return ratios;
}

std::vector<double> detuned_ratios(const DesignStudy& study) {
  std::vector<double> ratios;
  ratios.reserve(study.detunings.size());
  for (const Detuning& detuning : study.detunings) {
    ratios.push_back(detuning.ratio);
  }
  return ratios;
}

/// At the fastest speed.
std::vector<DesignPoint> fastest_points(const DesignStudy& study) {
  std::vector<DesignPoint> points;
  for (const DesignPoint& point : moving_points(study)) {
    if (point.requirement.sliding_m_per_s == study.task.speeds.fastest_m_per_s) {
      points.push_back(point);
    }
  }
  return points;
}

}  // namespace

std::string draw_requirements(const DesignStudy& study) {
  const double most_N = study.task.scene.max_drive_force_N();
  const auto force = [](const Requirement& each) { return each.motion.drive_force_N; };
  const auto power = [](const Requirement& each) { return each.motion.drive_power_W; };
  std::string script = requirement_blocks(study, "force", force) +
                       requirement_blocks(study, "power", power) + undriven_block(study) +
                       design_point_block(study) + style();
  const std::vector<Requirement>& over_speed = study.curves.front().requirements;
  script += fmt::format(
      "set multiplot layout 1,2\nset logscale xy\nset format x '%h'\nset format y '10^{{%L}}'\n"
      "set xrange [{:.9g}:{:.9g}]\n",
      over_speed.front().sliding_m_per_s, over_speed.back().sliding_m_per_s);
  const auto y_range = [](const std::vector<double>& values, double about) {
    return output::range_command('y', values, output::Scale::logarithmic, about);
  };
  script += shade_above(most_N) + y_range(figures(study, force), most_N) +
            axes("Required drive force (shaded: more than the drive has)", "sliding velocity [m/s]",
                 "force amplitude [N]") +
            curves(ratios_of(study), "force",
                   ", $points using 1:2 with points pt 7 ps 0.6 lc rgb '#111111' notitle");
  script += "unset object 1\n" + y_range(figures(study, power), 1.0) +
            axes("Power that the drive puts in", "sliding velocity [m/s]", "power [W]") +
            curves(ratios_of(study), "power",
                   ", $undriven using 1:2 with lines dt 2 lw 2 lc rgb '#111111' title 'friction, "
                   "undriven'");
  return output::draw_svg(script + "unset multiplot\n", 2 * panel_width_px, panel_height_px);
}

std::string draw_sensitivities(const DesignStudy& study) {
  const std::vector<DesignPoint> points = fastest_points(study);
  std::string lines;
  for (std::size_t row = 0; row < points.front().sensitivities.size(); ++row) {
    lines += points.front().sensitivities[row].parameter.symbol;
    for (const DesignPoint& point : points) {
      const double height = point.sensitivities[row].logarithmic;
      lines += fmt::format(" {:.9g}", std::isfinite(height) ? height : 0.0);
    }
    lines += '\n';
  }
  std::string plots;
  for (std::size_t i = 0; i < points.size(); ++i) {
    plots += fmt::format("{}$bars using {}{} lc rgb '{}' title 'ratio {:g}'",
                         plots.empty() ? "plot " : ", ", i + 2, i == 0 ? ":xtic(1)" : "", colour(i),
                         points[i].requirement.ratio);
  }
  return output::draw_svg(
      output::data_block("bars", lines) + style() +
          "set style data histograms\nset style histogram clustered gap 1\n"
          "set style fill solid border rgb '#ffffff'\nset xzeroaxis lc rgb '#111111' lw 1\n"
          "set ylabel 'change of the ratio in %, for 1 % of the parameter'\n" +
          plots + '\n',
      2 * panel_width_px, 360);
}

std::string draw_detunings(const DesignStudy& study) {
  const scene::Scene& scene = study.task.scene;
  const char* tuning_label = "Ks/(m w^2) [-]";
  const std::vector<double> ratios = detuned_ratios(study);
  std::string script = detuning_blocks(study, "ratio", &DetunedPoint::ratio_at_same_force) +
                       detuning_blocks(study, "force", &DetunedPoint::drive_force_N) +
                       detuning_blocks(study, "change", &DetunedPoint::change_by_stiffness) +
                       style();
  script += fmt::format(
      "set multiplot layout 1,3\nset xrange [0:{1:.9g}]\n"
      "set arrow 1 from first {0:.9g}, graph 0 to first {0:.9g}, graph 1 nohead dt 3 lw 1.5 lc rgb "
      "'#606060'\nset label 1 'scene' at first {0:.9g}, graph 0.03 offset 0.4,0 tc rgb '#606060'\n",
      study.tuning, study.detunings.front().points.back().tuning);
  script += axes("Ratio under the scene's force", tuning_label, "friction ratio [-]") +
            "set yrange [0:1]\n" + curves(ratios, "ratio", "");
  script += "set logscale y\nset format y '10^{%L}'\n" +
            output::range_command('y', figures(study, &DetunedPoint::drive_force_N),
                                  output::Scale::logarithmic, scene.max_drive_force_N()) +
            shade_above(scene.max_drive_force_N()) +
            axes("Force that keeps the ratio", tuning_label, "force amplitude [N]") +
            curves(ratios, "force", "");
  script += "set yrange [1e-5:1]\n" + shade_above(scene.run.settling_band) +
            axes("Change of the ratio for 1 % of Ks", tuning_label, "friction ratio [-]") +
            curves(ratios, "change", "");
  return output::draw_svg(script + "unset multiplot\n", 3 * panel_width_px * 4 / 5,
                          panel_height_px);
}

}  // namespace sonoglide::design
