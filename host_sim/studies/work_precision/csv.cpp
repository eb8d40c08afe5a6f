#include "host_sim/studies/work_precision/csv.hpp"

#include <fmt/format.h>

#include "host_sim/output/csv_number.hpp"
#include "host_sim/text/csv_cell.hpp"

namespace sonoglide::work_precision {
namespace {

std::string cell(double value) {
  constexpr int digits = 6;
  return output::csv_number(value, digits);
}

}  // namespace

std::string to_csv(const Comparison& comparison) {
  std::string csv = "solver,setting,relative_error,wall_us_per_period,steps_per_period,status\n";
  for (const Row& row : comparison.rows) {
    csv += fmt::format("{},{},{},{},{},{}\n", row.solver->name,
                       setting_text(row.solver->knob, row.setting), cell(row.error),
                       cell(row.wall_us_per_period), cell(row.steps_per_period),
                       text::csv_cell(row.status));
  }
  return csv;
}

}  // namespace sonoglide::work_precision
