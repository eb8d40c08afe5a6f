#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "host_sim/loop/run.hpp"
#include "host_sim/report/extremes_curve.hpp"
#include "host_sim/report/words.hpp"
#include "host_sim/scene_file/echo.hpp"
#include "host_sim/studies/robust/report.hpp"

namespace sonoglide::robust {
namespace {

constexpr std::size_t most_points_drawn = 2000;

std::string lead(const Task& task, const Study& study) {
  return fmt::format(
      "The loop of {} on {} inside its tolerances, and a search of {} for the worst of them. The "
      "controller is the same on all: it is designed for the scene.{}",
      task.nominal().name, counted(study.samples.size(), "plant"),
      counted(study.search.size(), "run"),
      task.nominal().controller->holds_force()
          ? " Overshoot, error and ripple of the force are over the friction limit of the plant at 0 s."
          : "");
}

std::vector<std::string> warnings(const Task& task, const Study& study) {
  std::vector<std::string> all = task.notes();
  const std::size_t failures = study.failures();
  if (failures > 0) {
    all.push_back(
        fmt::format("The loop fails on {} of {}: a fault, a step that never settles, or no result.",
                    failures, counted(study.samples.size(), "plant")));
  } else if (study.search_failures() > 0) {
    all.emplace_back("No sample fails, but the search has found a plant on which the loop fails.");
  }
  return all;
}

output::Table findings_table(const Study& study) {
  const std::size_t failures = study.failures();
  output::Table table{"Findings", {}, {}};
  table.rows.push_back({"Plants", fmt::format("{}", study.samples.size())});
  table.rows.push_back({"Failures", fmt::format("{}", failures)});
  for (const auto& [confidence, text] :
       {std::pair{0.95, "95 %"}, {0.99, "99 %"}, {0.999, "99.9 %"}}) {
    table.rows.push_back(
        {fmt::format("Probability of failure, at most, at {}", text),
         fmt::format("{:.3g} %", 100.0 * failure_probability_upper(failures, study.samples.size(),
                                                                   confidence))});
  }
  for (const NameCount& each : count_names(study, limit_names)) {
    table.rows.push_back({"Limit " + each.name, "on " + counted(each.count, "plant")});
  }
  for (const NameCount& each : count_names(study, fault_names)) {
    table.rows.push_back({"Fault " + each.name, "on " + counted(each.count, "plant")});
  }
  return table;
}

output::Table quantile_table(const Study& study) {
  output::Table table{"Of each figure the worst target step of a plant",
                      {"Figure", "Median", "95 %", "99 %", "Worst", "Worst plant"},
                      {}};
  for (const Figure& figure : figures()) {
    const Quantiles found = quantiles(values_of(study, figure));
    const auto cell = [&figure](double value) {
      return std::isnan(value) ? figure.undefined : fmt::format("{:.4g}", value);
    };
    table.rows.push_back({figure.label, cell(found.median), cell(found.p95), cell(found.p99),
                          cell(found.worst), cell(study.worst.row.*figure.value)});
  }
  return table;
}

output::Table factor_table(const Task& task, const Study& study) {
  output::Table table{"True values",
                      {"Key", "The scene's", "Lowest sample", "Highest sample", "Worst plant",
                       "Worst over the scene's"},
                      {}};
  for (std::size_t i = 0; i < task.tolerances().size(); ++i) {
    const scene::Tolerance& each = task.tolerances()[i];
    const std::vector<double> values = factors_of(task, i);
    const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
    const double worst = study.worst.factors[i];
    table.rows.push_back({each.key, fmt::format("{:.6g}", each.nominal),
                          fmt::format("{:.6g}", *lowest), fmt::format("{:.6g}", *highest),
                          fmt::format("{:.6g}", worst),
                          each.nominal != 0.0 ? fmt::format("{:.5f}", worst / each.nominal) : "-"});
  }
  return table;
}

/// Indices in rising order of the values, at most so many, evenly picked.
std::vector<std::size_t> drawn_order(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  if (order.size() <= most_points_drawn) {
    return order;
  }
  std::vector<std::size_t> picked;
  for (std::size_t i = 0; i < most_points_drawn; ++i) {
    picked.push_back(order[i * (order.size() - 1) / (most_points_drawn - 1)]);
  }
  return picked;
}

/// Part of the plants that stay at or below a value.
std::optional<output::Chart> distribution(const Study& study, const Figure& figure) {
  std::vector<double> values = values_of(study, figure);
  const auto all = static_cast<double>(values.size());
  values.erase(std::remove_if(values.begin(), values.end(), [](double v) { return std::isnan(v); }),
               values.end());
  if (values.empty()) {
    return std::nullopt;
  }
  std::sort(values.begin(), values.end());
  if (is_one_value(values.front(), values.back())) {
    return std::nullopt;
  }
  output::Chart chart;
  const std::string label = figure.label;
  chart.title = label.substr(0, label.find(" ["));
  chart.x_axis.label = figure.label;
  chart.y_axis.label = "Part of the plants at or below [-]";
  output::Curve series{"Plants", {}, output::Line::stepped};
  const std::size_t step = (values.size() - 1) / most_points_drawn + 1;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % step == 0 || i + 1 == values.size()) {
      chart.x.push_back(values[i]);
      series.y.push_back(static_cast<double>(i + 1) / all);
    }
  }
  chart.curves.push_back(std::move(series));
  return chart;
}

output::Section distribution_section(const Study& study) {
  output::Section section{
      "Distributions",
      "A curve that ends below 1 leaves out the plants that have no such figure: "
      "a step never settles, or the loop could not be computed. A figure that is the same on all "
      "plants has no curve.",
      {}};
  for (const Figure& figure : figures()) {
    if (auto chart = distribution(study, figure)) {
      section.charts.push_back(std::move(*chart));
    }
  }
  return section;
}

/// @param least  what is smaller is not told from 0
output::Table importance_table(const Task& task, const std::vector<std::vector<Importance>>& found,
                               const char* title, double Importance::*measure, double least) {
  output::Table table{title, {"Key"}, {}};
  for (const Figure& figure : figures()) {
    table.header.emplace_back(figure.label);
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    std::vector<std::string> row = {task.tolerances()[i].key};
    for (const Importance& each : found[i]) {
      row.push_back(std::abs(each.*measure) < least ? fmt::format("below {:.2g}", least)
                                                    : report::figure("{:.3f}", each.*measure));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

output::Chart scatter(const Task& task, const Study& study, std::size_t tolerance) {
  const std::vector<double> factors = factors_of(task, tolerance);
  output::Chart chart;
  chart.title = task.tolerances()[tolerance].key;
  chart.x_axis.label = task.tolerances()[tolerance].key;
  chart.x_axis.verbatim = true;
  chart.y_axis.label = "|Steady error| + ripple [-]";
  output::Curve settled{"Settled", {}, output::Line::dots};
  output::Curve failed{"Failed", {}, output::Line::dots};
  for (const std::size_t i : drawn_order(factors)) {
    const PlantRow& row = study.samples[i];
    output::Curve& curve = row.failed() ? failed : settled;
    curve.x.push_back(factors[i]);
    curve.y.push_back(row.deviation);
  }
  for (output::Curve* each : {&settled, &failed}) {
    if (!each->y.empty()) {
      chart.curves.push_back(std::move(*each));
    }
  }
  return chart;
}

/// By what they explain of the deviation, the most first.
std::vector<std::size_t> by_importance(const Task& task, const Study& study) {
  const Ranks deviations(values_of(study, {"deviation", "", &PlantRow::deviation, ""}));
  std::vector<double> effects;
  for (std::size_t i = 0; i < task.tolerances().size(); ++i) {
    const double effect = main_effect(Ranks(factors_of(task, i)), deviations);
    effects.push_back(std::isnan(effect) ? 0.0 : effect);
  }
  std::vector<std::size_t> order(effects.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return effects[a] > effects[b]; });
  return order;
}

output::Section importance_section(const Task& task, const Study& study) {
  constexpr std::size_t most_scatters = 4;
  output::Section section{
      "What matters",
      fmt::format(
          "The rank correlation shows whether a figure rises (towards 1) or falls (towards -1) "
          "with the key. The main effect is the part of the variance of the ranks that the key "
          "explains alone, also where the figure turns: 1 is all of it. {} plants have one of "
          "{:.2g} by chance: what is below that is not distinguished from none.",
          study.samples.size(), effect_of_chance(study.samples.size())),
      {}};
  const std::vector<std::vector<Importance>> found = importance(task, study);
  section.tables = {
      importance_table(task, found, "Main effect", &Importance::main_effect,
                       effect_of_chance(study.samples.size())),
      importance_table(task, found, "Rank correlation", &Importance::rank_correlation, 0.0)};
  const std::vector<std::size_t> order = by_importance(task, study);
  for (std::size_t i = 0; i < std::min(order.size(), most_scatters); ++i) {
    section.charts.push_back(scatter(task, study, order[i]));
  }
  return section;
}

/// Target, and what is held, of the carrier periods.
struct Course final : loop::PeriodSink {
  static constexpr std::size_t most_points = 4000;
  bool of_force;
  report::ExtremesCurve<2> curve{most_points};

  explicit Course(bool force) : of_force(force) {}

  void take(const loop::Period& period) override {
    curve.add(period.end_s,
              {period.target, of_force ? period.friction_force_N : period.friction_ratio});
  }
};

output::Chart loop_chart(const std::string& title, const scene::Scene& scene,
                         const configure::ControlDesign& design) {
  const bool of_force = scene.controller->holds_force();
  const std::string held = of_force ? "Friction force" : "Friction ratio";
  Course course(of_force);
  loop::Watch watch;
  watch.periods.push_back(&course);
  output::Chart chart;
  chart.title = title;
  chart.x_axis.label = "Time [s]";
  chart.y_axis.label = held + (of_force ? " [N]" : " [-]");
  chart.group = "loops";
  try {
    loop::run(scene, design, watch);
  } catch (const loop::ComputationError& error) {
    chart.note = fmt::format("Ends early: {}.", error.what());
  }
  chart.x = course.curve.x();
  chart.curves = {{"Target", course.curve.y(0), output::Line::stepped}, {held, course.curve.y(1)}};
  return chart;
}

output::Section worst_section(const Task& task, const Study& study) {
  output::Section section{
      "The worst loop",
      fmt::format(
          "Found by {}: the plant with the largest |steady error| + ripple; one on which the loop "
          "fails comes before all others. Its true values are below. sonoglide run worst.toml "
          "gives the same loop.",
          study.worst.found_by),
      {}};
  section.charts.push_back(
      loop_chart("Worst plant", task.plant(study.worst.factors), task.design()));
  section.charts.push_back(loop_chart("The scene's own plant", task.own_plant(), task.design()));
  section.tables = {factor_table(task, study)};
  return section;
}

}  // namespace

output::Page robust_page(const Task& task, const Study& study) {
  return {
      fmt::format("Robustness of {}", task.nominal().name),
      lead(task, study),
      warnings(task, study),
      {findings_table(study), quantile_table(study)},
      {worst_section(task, study), distribution_section(study), importance_section(task, study)},
      scene_file::to_json(task.nominal()),
      task.counts().seed};
}

}  // namespace sonoglide::robust
