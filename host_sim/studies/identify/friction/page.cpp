#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

#include "host_sim/output/number.hpp"
#include "host_sim/studies/identify/friction/comparison.hpp"
#include "host_sim/studies/identify/identification.hpp"

namespace sonoglide::identify::friction {
namespace {

constexpr std::size_t most_groups = 6;

/// Readings that share one of the two velocities, the vibration's or the sliding's.
using Group = std::vector<Reading>;

struct Groups {
  double Reading::*held;
  double Reading::*other;
  std::vector<Group> all;  ///< the largest first

  bool vibration_is_held() const { return held == &Reading::vibration_m_per_s; }
};

std::vector<Group> grouped(const Readings& readings, double Reading::*held) {
  std::map<std::string, Group> by_value;
  for (const Reading& row : readings.rows) {
    // Three digits: set and measured velocities differ in the fourth.
    by_value[fmt::format("{:.3g}", row.*held)].push_back(row);
  }
  std::vector<Group> groups;
  groups.reserve(by_value.size());
  for (auto& [text, group] : by_value) {
    groups.push_back(std::move(group));
  }
  std::stable_sort(groups.begin(), groups.end(),
                   [](const Group& a, const Group& b) { return a.size() > b.size(); });
  return groups;
}

Groups groups_of(const Readings& readings) {
  constexpr auto vibration = &Reading::vibration_m_per_s;
  constexpr auto sliding = &Reading::sliding_m_per_s;
  Groups by_vibration = {vibration, sliding, grouped(readings, vibration)};
  Groups by_sliding = {sliding, vibration, grouped(readings, sliding)};
  return by_vibration.all.size() <= by_sliding.all.size() ? by_vibration : by_sliding;
}

/// A group's readings with their standard errors, and the laws from 0 to beyond them.
output::Chart fit_chart(const Comparison& comparison, const Groups& groups, const Group& group) {
  const Readings& readings = comparison.readings;
  output::Chart chart;
  chart.title = fmt::format("{} at {}", groups.vibration_is_held() ? "Vibration" : "Sliding",
                            output::quantity(group.back().*groups.held, "m/s"));
  chart.x_axis.label =
      groups.vibration_is_held() ? "Sliding velocity [m/s]" : "Peak vibration velocity [m/s]";
  chart.y_axis.label = readings.are_forces ? "Mean friction [N]" : "Friction ratio [-]";
  output::Curve measured =
      dots(readings.have_standard_errors ? "measured ± standard error" : "measured");
  double fastest = 0.0;
  for (const Reading& row : group) {
    fastest = std::max(fastest, row.*groups.other);
    measured.x.push_back(row.*groups.other);
    measured.y.push_back(row.friction);
    if (readings.have_standard_errors) {
      measured.half_width.push_back(row.standard_error);
    }
  }
  chart.curves.push_back(std::move(measured));
  for (const LawFit& law : comparison.laws) {
    output::Curve& curve = chart.curves.emplace_back(output::Curve{law.law.title, {}});
    constexpr int points = 120;
    for (int i = 1; i <= points; ++i) {
      Reading row = group.front();
      row.*groups.other = 1.1 * fastest * i / points;
      curve.x.push_back(row.*groups.other);
      curve.y.push_back(friction_of(readings, law, row));
    }
  }
  return chart;
}

output::Section fit_section(const Comparison& comparison) {
  const Groups groups = groups_of(comparison.readings);
  const char* held = groups.vibration_is_held() ? "vibration" : "sliding";
  output::Section section;
  section.title = "Readings and fits";
  section.text = fmt::format(
      "Readings with the same {} velocity are in one panel{}. Curves are the fitted laws at the "
      "panel's {} velocity.",
      held,
      groups.all.size() > most_groups
          ? fmt::format("; of {} such velocities those {} with the most readings are shown",
                        groups.all.size(), most_groups)
          : std::string(),
      held);
  for (std::size_t i = 0; i < std::min(groups.all.size(), most_groups); ++i) {
    section.charts.push_back(fit_chart(comparison, groups, groups.all[i]));
  }
  return section;
}

/// Over the order of the readings, in which runs are counted.
output::Section residual_section(const Comparison& comparison) {
  output::Section section;
  section.title = "Residuals";
  section.text =
      "Measured less fitted, in the order of the velocity ratio. Scatter changes its sign from "
      "reading to reading; a law that is wrong leaves long runs of one sign.";
  for (const LawFit& each : comparison.laws) {
    output::Chart chart;
    chart.title = each.law.title;
    chart.note =
        fmt::format("Runs: probability {:.2g} of so few; correlation of neighbours {:.2f}.",
                    each.runs_probability, each.autocorrelation);
    chart.x_axis.label = "Reading, by rising velocity ratio [-]";
    chart.y_axis.label = comparison.readings.are_forces ? "Residual [N]" : "Residual [-]";
    chart.x_axis.whole_numbers = true;
    chart.y_axis.has_zero = true;
    chart.curves = {dots("residual", {}, each.residuals)};
    for (std::size_t i = 0; i < each.residuals.size(); ++i) {
      chart.curves.front().x.push_back(static_cast<double>(i + 1));
    }
    chart.group = "residuals";
    section.charts.push_back(std::move(chart));
  }
  return section;
}

output::Table law_table(const Comparison& comparison) {
  const bool has_errors = comparison.readings.have_standard_errors;
  output::Table table{"Laws, the best first",
                      {"Law (--law)", "Verdict", "Vibration", "p", "AICc, difference",
                       "Residual rms", "Misfit", "P(runs)"},
                      {}};
  if (has_errors) {
    table.header.emplace_back("P(chi²)");
  }
  const auto cell = [](double value) { return output::formatted(value, "{:.3g}"); };
  for (const LawFit& each : comparison.laws) {
    table.rows.push_back({fmt::format("{} ({})", each.law.title, each.law.law),
                          verdict(comparison, each), each.law.direction,
                          fmt::format("{}", each.parameter_count()),
                          cell(comparison.difference(each)), cell(each.residual_rms),
                          cell(each.misfit), cell(each.runs_probability)});
    if (has_errors) {
      table.rows.back().push_back(cell(each.chi_square_probability));
    }
  }
  return table;
}

output::Table parameter_table(const Comparison& comparison) {
  output::Table table{"Parameters", {"Law", "Parameter", "Value", "95 % from", "to"}, {}};
  for (const LawFit& law : comparison.laws) {
    const char* no_end = comparison.is_possible(law) ? "open" : "-";
    for (const Estimate& each : law.parameters) {
      table.rows.push_back({law.law.title, each.name, formatted(each.name, each.value, "open"),
                            formatted(each.name, each.low_95, no_end),
                            formatted(each.name, each.high_95, no_end)});
    }
  }
  return table;
}

}  // namespace

output::Page page(const Comparison& comparison, const std::string& name) {
  output::Page page;
  page.title = fmt::format("Friction of {}", name);
  page.lead = fmt::format(
      "{} readings of {} against {}. Residuals and misfit are friction ratios; p is the number "
      "of parameters. AICc is "
      "Akaike's criterion for small samples: laws less than {:g} apart are not separated. "
      "P(runs) is the probability of so few runs of one sign if the residuals were white{}. "
      "Intervals are of profile likelihood, with a term for misfit.",
      comparison.readings.rows.size(),
      comparison.readings.are_forces ? "mean friction" : "the friction ratio",
      comparison.laws.size() == 1 ? std::string("one law")
                                  : fmt::format("{} laws", comparison.laws.size()),
      told_apart_from,
      comparison.readings.have_standard_errors
          ? ", P(chi²) that of residuals so large by the standard errors"
          : "");
  page.warnings = comparison.warnings;
  page.tables = {law_table(comparison), parameter_table(comparison)};
  page.sections = {{"What the readings cannot tell",
                    "An open value is one that the fit puts at the bound of its range, where the "
                    "law becomes a simpler one, or that the readings leave open by more than a "
                    "factor of ten. An open end means that the residuals hardly grow as far as "
                    "that parameter may go. Laws that are not possible get no intervals.",
                    {},
                    {sentence_table("", comparison.cannot_tell)}},
                   fit_section(comparison),
                   residual_section(comparison)};
  return page;
}

}  // namespace sonoglide::identify::friction
