#include "host_sim/studies/sweep/report.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <string>

#include "host_sim/output/number.hpp"
#include "host_sim/report/words.hpp"

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
                     report::limit_name(row.limit));
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
    cells += fmt::format("{}{},", target_cells(plan, row), report::fault_name(row.fault));
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

}  // namespace sonoglide::sweep
