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
  if (plan.closed_loop()) {
    text += plan.first().controller->holds_force()
                ? "settling_time_s,steady_error_N,ripple_N,limit,fault,"
                : "settling_time_s,steady_error,ripple,limit,fault,";
  }
  return text + "status\n";
}

std::string line(const Plan& plan, std::size_t point, const PointResult& row) {
  std::string cells;
  for (std::size_t axis = 0; axis < plan.grid().axes().size(); ++axis) {
    cells += output::csv_cell(plan.grid().text(point, axis)) + ',';
  }
  cells += output::csv_cells({row.friction_ratio_whole_run, row.friction_ratio_window,
                              row.dissipation_ratio_window}) +
           ',';
  if (plan.closed_loop()) {
    cells += fmt::format("{},{},{},",
                         output::csv_cells({row.settling_time_s, row.steady_error, row.ripple}),
                         report::limit_name(row.limit), report::fault_name(row.fault));
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
