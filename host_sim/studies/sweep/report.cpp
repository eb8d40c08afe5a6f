#include "host_sim/studies/sweep/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "firmware/control/interface/names.hpp"
#include "host_sim/output/number.hpp"
#include "host_sim/report/words.hpp"
#include "host_sim/scene_file/echo.hpp"
#include "host_sim/studies/sweep/free_vibration.hpp"

namespace sonoglide::sweep {
namespace {

std::string heading(const Plan& plan) {
  std::string text;
  for (const Axis& axis : plan.grid().axes()) {
    text += axis.key + ',';
  }
  text += "friction_ratio_whole_run,friction_ratio_window,dissipation_ratio_window,";
  if (plan.first().load) {
    text += "load_final_velocity_m_per_s,load_final_displacement_m,";
  }
  if (plan.closed_loop()) {
    const scene::Controller& controller = *plan.first().controller;
    const char* const unit = controller.holds_force() ? "_N" : "";
    text += controller.texture
                ? fmt::format("texture_mean_error{},texture_amplitude_ratio,texture_lag_deg,", unit)
                : fmt::format("settling_time_s,steady_error{0},ripple{0},limit,", unit);
    text += "fault,";
  }
  return text + "status\n";
}

/// Of the last target step, or of the texture.
std::string target_cells(const Plan& plan, const PointResult& row) {
  if (plan.first().controller->texture) {
    return output::csv_cells(
               {row.texture_mean_error, row.texture_amplitude_ratio, row.texture_lag_deg}) +
           ',';
  }
  return fmt::format("{},{},",
                     output::csv_cells({row.settling_time_s, row.steady_error, row.ripple}),
                     control::name(row.limit));
}

std::string line(const Plan& plan, std::size_t point, const PointResult& row) {
  std::string cells;
  for (std::size_t axis = 0; axis < plan.grid().axes().size(); ++axis) {
    cells += output::csv_cell(plan.grid().text(point, axis)) + ',';
  }
  cells += output::csv_cells({row.friction_ratio_whole_run, row.friction_ratio_window,
                              row.dissipation_ratio_window}) +
           ',';
  if (plan.first().load) {
    cells +=
        output::csv_cells({row.load_final_velocity_m_per_s, row.load_final_displacement_m}) + ',';
  }
  if (plan.closed_loop()) {
    cells += fmt::format("{}{},", target_cells(plan, row), control::name(row.fault));
  }
  return cells + output::csv_cell(row.status) + '\n';
}

}  // namespace

void write_heading(std::ostream& out, const Plan& plan) {
  out << heading(plan);
}

void write_row(std::ostream& out, const Plan& plan, std::size_t point, const PointResult& row) {
  out << line(plan, point, row);
}

void write_csv(std::ostream& out, const Plan& plan, const std::vector<PointResult>& rows) {
  write_heading(out, plan);
  for (std::size_t point = 0; point < rows.size(); ++point) {
    write_row(out, plan, point, rows[point]);
  }
}

namespace {

struct Figure {
  const char* name;
  double PointResult::*value;
};

std::vector<Figure> figures(const Plan& plan) {
  std::vector<Figure> all = {
      {"Friction ratio, whole run", &PointResult::friction_ratio_whole_run},
      {"Friction ratio, window", &PointResult::friction_ratio_window},
      {"Power dissipation ratio, window", &PointResult::dissipation_ratio_window}};
  if (plan.first().load) {
    all.push_back(
        {"Velocity of the load at the end [m/s]", &PointResult::load_final_velocity_m_per_s});
    all.push_back(
        {"Displacement of the load at the end [m]", &PointResult::load_final_displacement_m});
  }
  if (!plan.closed_loop()) {
    return all;
  }
  const scene::Controller& controller = *plan.first().controller;
  const bool of_force = controller.holds_force();
  if (controller.texture) {
    all.push_back({of_force ? "Error of the texture's mean [N]" : "Error of the texture's mean",
                   &PointResult::texture_mean_error});
    all.push_back({"Amplitude of the texture's largest harmonic, rendered over wanted",
                   &PointResult::texture_amplitude_ratio});
    all.push_back({"Lag of that harmonic [deg]", &PointResult::texture_lag_deg});
    return all;
  }
  all.push_back({"Settling time, last target step [s]", &PointResult::settling_time_s});
  all.push_back({of_force ? "Steady error, last target step [N]" : "Steady error, last target step",
                 &PointResult::steady_error});
  all.push_back({of_force ? "Ripple, last target step [N]" : "Ripple, last target step",
                 &PointResult::ripple});
  return all;
}

std::size_t failures(const std::vector<PointResult>& rows) {
  return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [](const PointResult& row) { return !row.ok(); }));
}

std::string lead(const Plan& plan) {
  return fmt::format("{} points, {}. One row for each point is in sweep.csv.", plan.grid().size(),
                     plan.closed_loop() ? "closed loop" : "open loop");
}

std::vector<std::string> warnings(const Plan& plan, const std::vector<PointResult>& rows) {
  std::vector<std::string> all;
  if (plan.first().friction.sign_convention == scene::SignConvention::as_printed) {
    all.emplace_back(
        "Sign convention as printed in the paper (V = Vt - x'): friction pumps energy into the "
        "vibration. The dissipative convention is V = Vt + x'.");
  }
  for (std::string& note : start_notes(plan)) {
    all.push_back(std::move(note));
  }
  const std::size_t failed = failures(rows);
  if (failed > 0) {
    const auto first =
        std::find_if(rows.begin(), rows.end(), [](const PointResult& row) { return !row.ok(); });
    all.push_back(fmt::format(
        "{} of {} points could not be computed. The first of them, at {}: {}.", failed, rows.size(),
        plan.describe(static_cast<std::size_t>(first - rows.begin())), first->status));
  }
  return all;
}

output::Table axis_table(const Plan& plan) {
  output::Table table{"Varied", {"Key", "From", "To", "Values", "Spacing"}, {}};
  for (const Axis& axis : plan.grid().axes()) {
    const char* spacing = axis.logarithmic ? "logarithmic" : "linear";
    table.rows.push_back({axis.key, axis.text(0), axis.text(axis.count - 1),
                          fmt::format("{}", axis.count), axis.list.empty() ? spacing : "listed"});
  }
  return table;
}

std::string short_text(const Grid& grid, std::size_t point, std::size_t axis) {
  const double number = grid.number(point, axis);
  return std::isnan(number) ? grid.text(point, axis) : fmt::format("{:.6g}", number);
}

output::Table extremes_table(const Plan& plan, const std::vector<PointResult>& rows) {
  output::Table table{"Extremes", {"Figure", "", "Value"}, {}};
  for (const Axis& axis : plan.grid().axes()) {
    table.header.push_back("at " + axis.key);
  }
  const auto add = [&](const char* name, const char* which, double value, std::size_t point) {
    std::vector<std::string> cells = {name, which, fmt::format("{:.6g}", value)};
    for (std::size_t axis = 0; axis < plan.grid().axes().size(); ++axis) {
      cells.push_back(short_text(plan.grid(), point, axis));
    }
    table.rows.push_back(std::move(cells));
  };
  for (const Figure& figure : figures(plan)) {
    if (const auto found = extremes(rows, figure.value)) {
      add(figure.name, "lowest", rows[found->lowest].*figure.value, found->lowest);
      add("", "highest", rows[found->highest].*figure.value, found->highest);
    }
  }
  return table;
}

std::string picture_note(const Plan& plan) {
  std::string note;
  for (const std::size_t axis : drawn_axes(plan.grid())) {
    const std::size_t count = plan.grid().axes()[axis].count;
    if (is_heat_map(plan.grid()) && count > most_cells_along) {
      note += fmt::format("One value of {} in {} is drawn. ", plan.grid().axes()[axis].key,
                          (count - 1) / most_cells_along + 1);
    }
  }
  return note;
}

}  // namespace

output::Page sweep_page(const Plan& plan, const std::vector<PointResult>& rows,
                        const std::optional<output::Sheet>& picture) {
  output::Page page{
      fmt::format("Sweep of {}", plan.first().name), lead(plan), warnings(plan, rows), {}, {}};
  std::vector<output::Table> tables = {axis_table(plan), extremes_table(plan, rows)};
  page.scene = scene_file::to_json(plan.first());
  if (picture) {
    output::Chart chart = picture->charts.front();
    chart.title = "Over what was varied";
    chart.note = picture_note(plan);
    page.sections = {{subject(plan).title, "", {std::move(chart)}, std::move(tables)}};
  } else {
    page.tables = std::move(tables);
  }
  return page;
}

Subject subject(const Plan& plan) {
  if (plan.closed_loop() && plan.first().controller->texture) {
    return {&PointResult::texture_amplitude_ratio, "Amplitude of the texture",
            "Amplitude of the texture, rendered over wanted [-]"};
  }
  if (plan.closed_loop() && plan.first().controller->holds_force()) {
    return {&PointResult::steady_error, "Steady error of the friction force",
            "Steady error of the friction force [N]"};
  }
  if (!plan.closed_loop() && plan.first().load) {
    return {&PointResult::load_final_displacement_m, "Displacement of the load",
            "Displacement of the load at the end [m]"};
  }
  return plan.closed_loop()
             ? Subject{&PointResult::steady_error, "Steady error of the friction ratio",
                       "Steady error of the friction ratio [-]"}
             : Subject{&PointResult::friction_ratio_window, "Friction ratio",
                       "Friction ratio, window [-]"};
}

std::optional<ExtremePoints> extremes(const std::vector<PointResult>& rows,
                                      double PointResult::*figure) {
  std::optional<ExtremePoints> found;
  for (std::size_t point = 0; point < rows.size(); ++point) {
    const double value = rows[point].*figure;
    if (std::isnan(value)) {
      continue;
    }
    if (!found) {
      found = ExtremePoints{point, point};
    }
    if (value < rows[found->lowest].*figure) {
      found->lowest = point;
    }
    if (value > rows[found->highest].*figure) {
      found->highest = point;
    }
  }
  return found;
}

}  // namespace sonoglide::sweep
