
#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "host_sim/output/number.hpp"
#include "host_sim/studies/work_precision/comparison.hpp"

namespace sonoglide::work_precision {
std::string to_csv(const SolverComparison& comparison) {
  constexpr int csv_digits = 6;
  std::string csv = "solver,setting,relative_error,wall_us_per_period,steps_per_period,status\n";
  for (const MeasuredSetting& row : comparison.rows) {
    csv += fmt::format(
        "{},{},{},{}\n", row.solver->name, setting_text(row.solver->knob, row.setting),
        output::csv_cells({row.error, row.wall_us_per_period, row.steps_per_period}, csv_digits),
        output::csv_cell(row.status));
  }
  return csv;
}

namespace {

/// What the cheapest solver whose name begins so costs, in units of the cheapest of all.
std::string times_the_fastest(const std::vector<const MeasuredSetting*>& rows,
                              std::string_view beginning) {
  const auto row =
      std::find_if(rows.begin(), rows.end(), [beginning](const MeasuredSetting* candidate) {
        return candidate->solver->name.compare(0, beginning.size(), beginning) == 0;
      });
  return row == rows.end() ? std::string("-")
                           : fmt::format("{:.3g}x", (*row)->wall_us_per_period /
                                                        rows.front()->wall_us_per_period);
}

std::string text(const SolverComparison& comparison) {
  std::string lines = fmt::format("{:>6}  {:24} {:>13} {:>10} {:>10} {:>10}\n", "error", "fastest",
                                  "us per period", "rk4_table", "dopri5", "cvode");
  for (const double accuracy : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const std::vector<const MeasuredSetting*> rows = cheapest(comparison, accuracy);
    if (!rows.empty()) {
      lines += fmt::format("{:>6.0e}  {:24} {:>13.3g} {:>10} {:>10} {:>10}\n", accuracy,
                           rows.front()->solver->name, rows.front()->wall_us_per_period,
                           times_the_fastest(rows, "rk4_table"), times_the_fastest(rows, "odeint"),
                           times_the_fastest(rows, "cvode"));
    }
  }
  return lines;
}

}  // namespace

output::StudyReport report(const scene::Scene& scene, const SolverComparison& comparison) {
  return {{{"work_precision.csv", to_csv(comparison)},
           {"work_precision.svg", output::print(diagram(scene, comparison))},
           {"report.html", output::to_html(page(scene, comparison))}},
          text(comparison)};
}

}  // namespace sonoglide::work_precision
