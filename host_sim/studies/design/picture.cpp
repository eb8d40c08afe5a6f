#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "host_sim/output/chart.hpp"
#include "host_sim/studies/design/report.hpp"

namespace sonoglide::design {
namespace {

constexpr int panel_width_px = 560;
constexpr int panel_height_px = 430;
constexpr const char* colours[] = {"#1f5fa8", "#d62728", "#1b9e5a", "#b8570f", "#7a3fa0"};
constexpr const char* black = "#111111";
constexpr const char* look =
    "set grid lc rgb '#d8d8d8'\nset tics out nomirror\nset border 3\nset rmargin 3\n"
    "set key outside top center horizontal samplen 2.5\n";

/// Shades a chart above a level.
std::string shade_above(double level) {
  return fmt::format(
      "set object 1 rectangle from graph 0, first {:.9g} to graph 1, graph 1 fc rgb '#f6dcdc' fs "
      "solid noborder behind\n",
      level);
}

/// Of a ratio, the index-th of the study's.
output::Curve ratio_curve(double ratio, std::size_t index) {
  output::Curve curve;
  curve.label = fmt::format("ratio {:g}", ratio);
  curve.pen = {colours[index % std::size(colours)], 2.2};
  return curve;
}

/// A figure of the requirements, a curve a ratio.
template <class Figure>
output::Chart over_speed(const DesignStudy& study, const char* title, const char* y_label,
                         const Figure& figure) {
  output::Chart chart{
      title, "", {"sliding velocity [m/s]", true, {}, "%h"}, {y_label, true, {}, "10^{%L}"},
      {},    {}};
  for (const Requirement& point : study.curves.front().requirements) {
    chart.x.push_back(point.sliding_m_per_s);
  }
  chart.x_axis.span = {chart.x.front(), chart.x.back()};
  for (std::size_t i = 0; i < study.curves.size(); ++i) {
    output::Curve& curve = chart.curves.emplace_back(ratio_curve(study.curves[i].ratio, i));
    for (const Requirement& point : study.curves[i].requirements) {
      curve.y.push_back(figure(point));
    }
  }
  return chart;
}

/// A figure on the way through resonance, a curve a ratio.
output::Chart over_tuning(const DesignStudy& study, const char* title, const char* y_label,
                          output::Span y_span, double DetunedPoint::*figure) {
  output::Chart chart{
      title,
      "",
      {"Ks/(m w^2) [-]", false, {0.0, study.detunings.front().points.back().tuning}},
      {y_label, false, y_span},
      {},
      {}};
  for (std::size_t i = 0; i < study.detunings.size(); ++i) {
    output::Curve& curve = chart.curves.emplace_back(ratio_curve(study.detunings[i].ratio, i));
    bool above = false;
    for (const DetunedPoint& point : study.detunings[i].points) {
      if (!above && point.tuning > 1.0) {
        // Nothing is known at resonance itself.
        above = true;
        curve.x.push_back(1.0);
        curve.y.push_back(undefined);
      }
      curve.x.push_back(point.tuning);
      curve.y.push_back(point.*figure);
    }
  }
  return chart;
}

void make_logarithmic(output::Axis& axis, double about) {
  axis.logarithmic = true;
  axis.format = "10^{%L}";
  axis.about = about;
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
  output::Chart force = over_speed(
      study, "Required drive force (shaded: more than the drive has)", "force amplitude [N]",
      [](const Requirement& each) { return each.motion.drive_force_N; });
  output::Chart power =
      over_speed(study, "Power that the drive puts in", "power [W]",
                 [](const Requirement& each) { return each.motion.drive_power_W; });
  output::Curve points{"", {}, output::Line::dots, {}, {black, 1.0, 1, 7, 0.6}};
  for (const DesignPoint& point : study.points) {
    points.x.push_back(point.requirement.sliding_m_per_s);
    points.y.push_back(point.requirement.motion.drive_force_N);
  }
  output::Curve undriven{"friction, undriven", {}, output::Line::joined, {}, {black, 2.0, 2}};
  for (const Requirement& point : study.curves.front().requirements) {
    undriven.y.push_back(point.motion.undriven_friction_power_W);
  }
  force.y_axis.about = most_N;
  force.look = shade_above(most_N);
  force.curves.push_back(std::move(points));
  power.look = "unset object 1\n";
  power.curves.push_back(std::move(undriven));
  return output::print(
      {{std::move(force), std::move(power)}, 2 * panel_width_px, panel_height_px, 2, look});
}

std::string draw_sensitivities(const DesignStudy& study) {
  const std::vector<DesignPoint> points = fastest_points(study);
  output::Chart chart{"", "", {}, {"change of the ratio in %, for 1 % of the parameter"}, {}, {}};
  for (const Sensitivity& each : points.front().sensitivities) {
    chart.x_axis.ticks.push_back({static_cast<double>(chart.x.size()), each.parameter.symbol});
    chart.x.push_back(static_cast<double>(chart.x.size()));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    output::Curve& bars = chart.curves.emplace_back(ratio_curve(points[i].requirement.ratio, i));
    bars.line = output::Line::bar;
    for (const Sensitivity& each : points[i].sensitivities) {
      bars.y.push_back(std::isfinite(each.logarithmic) ? each.logarithmic : 0.0);
    }
  }
  chart.look =
      "set style data histograms\nset style histogram clustered gap 1\n"
      "set style fill solid border rgb '#ffffff'\nset xzeroaxis lc rgb '#111111' lw 1\n";
  return output::print({{std::move(chart)}, 2 * panel_width_px, 360, 0, look});
}

std::string draw_detunings(const DesignStudy& study) {
  const scene::Scene& scene = study.task.scene;
  const double most_N = scene.max_drive_force_N();
  output::Chart ratio = over_tuning(study, "Ratio under the scene's force", "friction ratio [-]",
                                    {0.0, 1.0}, &DetunedPoint::ratio_at_same_force);
  output::Chart force = over_tuning(study, "Force that keeps the ratio", "force amplitude [N]", {},
                                    &DetunedPoint::drive_force_N);
  output::Chart change =
      over_tuning(study, "Change of the ratio for 1 % of Ks", "friction ratio [-]", {1e-5, 1.0},
                  &DetunedPoint::change_by_stiffness);
  const std::string tuning = fmt::format(
      "set arrow 1 from first {0:.9g}, graph 0 to first {0:.9g}, graph 1 nohead dt 3 lw 1.5 lc rgb "
      "'#606060'\nset label 1 'scene' at first {0:.9g}, graph 0.03 offset 0.4,0 tc rgb '#606060'\n",
      study.tuning);
  make_logarithmic(force.y_axis, most_N);
  make_logarithmic(change.y_axis, 1.0);
  ratio.look = tuning;
  force.look = tuning + shade_above(most_N);
  change.look = tuning + shade_above(scene.run.settling_band);
  return output::print({{std::move(ratio), std::move(force), std::move(change)},
                        3 * panel_width_px * 4 / 5,
                        panel_height_px,
                        3,
                        look});
}

}  // namespace sonoglide::design
