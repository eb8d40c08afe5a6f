#include "host_sim/studies/identify/impedance/report.hpp"

#include <fmt/format.h>

#include <limits>

#include "host_sim/output/csv.hpp"
#include "host_sim/studies/identify/report.hpp"

namespace sonoglide::identify::impedance {
namespace {

/// Frequency, measured and fitted admittance, relative residuals; 17 digits.
std::string fit_csv(const ImpedanceStudy& study) {
  constexpr int digits = 17;
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const auto cell = [](double value) { return output::csv_number(value, digits); };
  std::string csv =
      "frequency_Hz,measured_conductance_S,measured_susceptance_S,fitted_conductance_S,"
      "fitted_susceptance_S,relative_residual_magnitude,residual_phase_rad\n";
  const std::size_t n = study.sweep.frequency_Hz.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double f = study.sweep.frequency_Hz[i];
    const std::complex<double> fitted = study.fit.circuit.admittance_S(f);
    const std::complex<double> measured = study.sweep.admittance_S[i];
    const bool phase = study.sweep.has_phase;
    const auto row = static_cast<Eigen::Index>(i);
    csv += fmt::format(
        "{},{},{},{},{},{},{}\n", cell(f), cell(phase ? measured.real() : unknown),
        cell(phase ? measured.imag() : unknown), cell(fitted.real()), cell(fitted.imag()),
        cell(study.fit.at.residuals(row)),
        cell(phase ? study.fit.at.residuals(row + static_cast<Eigen::Index>(n)) : unknown));
  }
  return csv;
}

std::string text(const ImpedanceStudy& study) {
  const Identification& identification = study.identification;
  std::string lines = fmt::format("{} readings, {}, as {}\n", study.sweep.frequency_Hz.size(),
                                  study.sweep.format, identification.model);
  for (const Estimate& each : identification.parameters) {
    lines +=
        fmt::format("{:<28} {:>12}   95 %: {} to {}\n", each.name, shown(each.name, each.value),
                    shown(each.name, each.low_95), shown(each.name, each.high_95));
  }
  return lines +
         fmt::format("residuals {:.3g}, of them misfit {:.3g} (relative, rms)\n",
                     identification.residual_rms, identification.misfit) +
         remark_lines(identification.warnings, identification.cannot_tell);
}

}  // namespace

output::StudyReport report(const ImpedanceStudy& study) {
  return {{{"report.html", output::to_html(page(study))},
           {"identify.json", to_json(study.identification).dump(2) + '\n'},
           {"fit.csv", fit_csv(study)},
           {"scene.toml", study.scene}},
          text(study)};
}

}  // namespace sonoglide::identify::impedance
