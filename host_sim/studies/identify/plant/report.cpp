#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <utility>

#include "host_sim/output/chart.hpp"
#include "host_sim/output/number.hpp"
#include "host_sim/output/page.hpp"
#include "host_sim/studies/identify/plant/study.hpp"

namespace sonoglide::identify::plant {
namespace {

std::string settling(const report::StepMetrics& step) {
  return step.settling_time_s ? output::quantity(*step.settling_time_s, "s", 3)
                              : std::string("never");
}

output::Table step_table(const PlantStudy& study) {
  output::Table table{"Steps of the scene on the plant that was found",
                      {"Target", "Settles as designed", "Error", "Settles commissioned", "Error"},
                      {}};
  const auto cell = [](double value) { return output::formatted(value, "{:.4f}"); };
  for (const StepComparison& each : study.steps) {
    table.rows.push_back({fmt::format("{:.4g}", each.designed.target), settling(each.designed),
                          cell(each.designed.steady_error), settling(each.commissioned),
                          cell(each.commissioned.steady_error)});
  }
  return table;
}

output::Chart chart(const PlantStudy& study, std::size_t index) {
  const Stretch& stretch = study.stretches[index];
  output::Curve measured = dots("measured");
  output::Curve modelled{"modelled", {}};
  const Eigen::VectorXd read = readings(stretch);
  for (Eigen::Index i = 0; i < read.size(); ++i) {
    const double step = static_cast<double>(i) - static_cast<double>(stretch.before);
    measured.x.push_back(step);
    measured.y.push_back(study.full_scale_N * read(i));
    modelled.x.push_back(step);
    modelled.y.push_back(study.full_scale_N * study.fit.modelled[index](i));
  }
  output::Chart chart;
  chart.title = stretch.name;
  chart.x_axis.label = "Step of the controller [-]";
  chart.x_axis.whole_numbers = true;
  chart.y_axis.label = "Mean friction force [N]";
  chart.curves = {std::move(measured), std::move(modelled)};
  return chart;
}

std::string change_sentence(const PlantStudy& study) {
  if (study.fit.changed.empty()) {
    return "commissioned.toml has every value of the scene: the readings are reason to change none.";
  }
  std::string words =
      "The intervals do not have these values of the scene, and commissioned.toml has others:";
  for (const auto& [key, value] : study.fit.changed) {
    words += fmt::format(" {} = {:.6g},", key, value);
  }
  words.back() = '.';
  return words;
}

output::Page page(const PlantStudy& study) {
  const Identification& found = study.fit.identification;
  output::Page page;
  page.title = fmt::format("Plant of the unit of {}", study.name);
  page.lead = fmt::format(
      "{} traces of a unit, and {} fitted to them: the readings that the simulation gives where it is driven as "
      "the unit was.",
      study.stretches.size(), found.model);
  page.warnings = found.warnings;
  page.notes = {change_sentence(study)};
  page.tables = {figure_table(found.parameters)};
  if (!found.cannot_tell.empty()) {
    page.tables.push_back(sentence_table("What the traces cannot tell", found.cannot_tell));
  }
  if (!study.steps.empty()) {
    page.tables.push_back(step_table(study));
  }
  output::Section section;
  section.title = "Traces and fit";
  section.text = fmt::format(
      "Residuals are {:.3g} of the undriven friction (rms). Step 0 is the first that answers to the other target.",
      found.residual_rms);
  for (std::size_t i = 0; i < study.stretches.size(); ++i) {
    section.charts.push_back(chart(study, i));
  }
  page.sections = {
      std::move(section),
      {"Correlations of the fitted parameters", "", {}, {correlation_table(found.correlations)}}};
  return page;
}

std::string fit_csv(const PlantStudy& study) {
  std::string csv =
      "trace,step,amplitude_code,measured_friction_force_N,modelled_friction_force_N\n";
  for (std::size_t k = 0; k < study.stretches.size(); ++k) {
    const Stretch& stretch = study.stretches[k];
    const Eigen::VectorXd read = readings(stretch);
    for (std::size_t i = 0; i < stretch.steps.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      csv +=
          fmt::format("{},{},{},{}\n", k,
                      static_cast<std::ptrdiff_t>(i) - static_cast<std::ptrdiff_t>(stretch.before),
                      stretch.steps[i].amplitude,
                      output::csv_cells({study.full_scale_N * read(at),
                                         study.full_scale_N * study.fit.modelled[k](at)}));
    }
  }
  return csv;
}

std::string text(const PlantStudy& study) {
  const Identification& found = study.fit.identification;
  std::string lines;
  for (const Estimate& each : found.parameters) {
    lines += fmt::format(
        "{:<40} {:>12}   95 %: {} to {}\n", each.name, formatted(each.name, each.value, "open"),
        formatted(each.name, each.low_95, "open"), formatted(each.name, each.high_95, "open"));
  }
  lines += change_sentence(study) + '\n';
  for (const StepComparison& each : study.steps) {
    lines +=
        fmt::format("target {:.4g}: settles {} as designed, {} commissioned\n",
                    each.designed.target, settling(each.designed), settling(each.commissioned));
  }
  return lines + remark_lines(found.warnings, found.cannot_tell);
}

}  // namespace

output::StudyReport report(const PlantStudy& study) {
  return {{{"report.html", output::to_html(page(study))},
           {"identify.json", to_json(study.fit.identification).dump(2) + '\n'},
           {"fit.csv", fit_csv(study)},
           {"commissioned.toml", study.scene}},
          text(study)};
}

}  // namespace sonoglide::identify::plant
