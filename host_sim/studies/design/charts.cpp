#include <fmt/format.h>

#include <utility>

#include "host_sim/output/chart.hpp"
#include "host_sim/studies/design/report.hpp"

namespace sonoglide::design {
namespace {

/// What lies above a level.
output::Tiles above(double level, const char* meaning) {
  return {{{{}, {level}}}, "#d55e00", meaning, true};
}

output::Curve ratio_curve(double ratio) {
  return {fmt::format("ratio {:g}", ratio), {}};
}

/// A figure of the requirements, a curve a ratio.
template <class Figure>
output::Chart over_speed(const DesignStudy& study, const char* title, const char* y_label,
                         const Figure& figure) {
  output::Chart chart{title, "", {"Sliding velocity [m/s]", true}, {y_label, true}, {}, {}};
  for (const steady::Requirement& point : study.curves.front().requirements) {
    chart.x.push_back(point.sliding_m_per_s);
  }
  for (const RatioRequirements& each : study.curves) {
    output::Curve& curve = chart.curves.emplace_back(ratio_curve(each.ratio));
    for (const steady::Requirement& point : each.requirements) {
      curve.y.push_back(figure(point));
    }
  }
  chart.group = "sliding velocity";
  return chart;
}

/// A figure on the way through resonance, a curve a ratio, and where the scene is.
output::Chart over_tuning(const DesignStudy& study, const char* title, const char* y_label,
                          double DetunedPoint::*figure) {
  output::Chart chart{title, "", {"Ks/(m ω²) [-]"}, {y_label}, {}, {}};
  for (const Detuning& each : study.detunings) {
    output::Curve& curve = chart.curves.emplace_back(ratio_curve(each.ratio));
    bool is_above = false;
    for (const DetunedPoint& point : each.points) {
      if (!is_above && point.tuning > 1.0) {
        // Nothing is known at resonance itself.
        is_above = true;
        curve.x.push_back(1.0);
        curve.y.push_back(steady::undefined);
      }
      curve.x.push_back(point.tuning);
      curve.y.push_back(point.*figure);
    }
  }
  chart.curves.push_back({"the scene", {1.0}, output::Line::full_height, {study.tuning}});
  chart.group = "tuning";
  return chart;
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

std::vector<output::Chart> requirement_charts(const DesignStudy& study) {
  output::Chart force =
      over_speed(study, "Required drive force", "Force amplitude [N]",
                 [](const steady::Requirement& each) { return each.motion.drive_force_N; });
  output::Chart power =
      over_speed(study, "Power that the drive puts in", "Power [W]",
                 [](const steady::Requirement& each) { return each.motion.drive_power_W; });
  output::Curve points{"asked for", {}, output::Line::dots};
  for (const DesignPoint& point : study.points) {
    points.x.push_back(point.requirement.sliding_m_per_s);
    points.y.push_back(point.requirement.motion.drive_force_N);
  }
  output::Curve undriven{"friction, undriven", {}};
  for (const steady::Requirement& point : study.curves.front().requirements) {
    undriven.y.push_back(point.motion.undriven_friction_power_W);
  }
  force.tiles = {above(study.task.scene.max_drive_force_N(), "more than the drive has")};
  force.curves.push_back(std::move(points));
  power.curves.push_back(std::move(undriven));
  return {std::move(force), std::move(power)};
}

output::Chart sensitivity_chart(const DesignStudy& study) {
  const std::vector<DesignPoint> points = fastest_points(study);
  output::Chart chart{"Change of the ratio at the fastest sliding",
                      "For 1 % of each parameter.",
                      {"Parameter"},
                      {"Change of the ratio [%]"},
                      {},
                      {}};
  for (const Sensitivity& each : points.front().sensitivities) {
    chart.x.push_back(static_cast<double>(chart.x.size()));
    chart.x_axis.ticks.push_back({chart.x.back(), each.parameter.symbol});
  }
  for (const DesignPoint& point : points) {
    output::Curve& bars = chart.curves.emplace_back(ratio_curve(point.requirement.ratio));
    bars.line = output::Line::bar;
    for (const Sensitivity& each : point.sensitivities) {
      bars.y.push_back(each.logarithmic);
    }
  }
  return chart;
}

std::vector<output::Chart> detuning_charts(const DesignStudy& study) {
  const scene::Scene& scene = study.task.scene;
  output::Chart ratio = over_tuning(study, "Ratio under the scene's force", "Friction ratio [-]",
                                    &DetunedPoint::ratio_at_same_force);
  output::Chart force = over_tuning(study, "Force that keeps the ratio", "Force amplitude [N]",
                                    &DetunedPoint::drive_force_N);
  output::Chart change = over_tuning(study, "Change of the ratio for 1 % of Ks",
                                     "Change of the ratio [-]", &DetunedPoint::change_by_stiffness);
  force.y_axis.logarithmic = true;
  force.tiles = {above(scene.max_drive_force_N(), "more than the drive has")};
  change.y_axis.logarithmic = true;
  change.tiles = {above(scene.run.settling_band, "too sensitive")};
  return {std::move(ratio), std::move(force), std::move(change)};
}

}  // namespace sonoglide::design
