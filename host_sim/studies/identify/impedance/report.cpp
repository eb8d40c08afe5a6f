#include "host_sim/studies/identify/impedance/report.hpp"

#include <fmt/format.h>

#include <limits>

#include "host_sim/output/number.hpp"
#include "host_sim/studies/identify/report.hpp"

namespace sonoglide::identify::impedance {
namespace {

/// Frequency, measured and fitted admittance, relative residuals.
std::string fit_csv(const ImpedanceStudy& study) {
  std::string csv =
      "frequency_Hz,measured_conductance_S,measured_susceptance_S,fitted_conductance_S,"
      "fitted_susceptance_S,relative_residual_magnitude,residual_phase_rad\n";
  const Eigen::VectorXd& residuals = study.fit.at.residuals;
  const auto n = static_cast<Eigen::Index>(study.sweep.frequency_Hz.size());
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  for (Eigen::Index i = 0; i < n; ++i) {
    const double f = study.sweep.frequency_Hz[static_cast<std::size_t>(i)];
    const std::complex<double> fitted = study.fit.circuit.admittance_S(f);
    const bool phase = study.sweep.has_phase;
    const std::complex<double> measured =
        phase ? study.sweep.admittance_S[static_cast<std::size_t>(i)]
              : std::complex<double>(unknown, unknown);
    csv += output::csv_cells({f, measured.real(), measured.imag(), fitted.real(), fitted.imag(),
                              residuals(i), phase ? residuals(i + n) : unknown}) +
           '\n';
  }
  return csv;
}

std::string text(const ImpedanceStudy& study) {
  const Identification& identification = study.identification;
  std::string lines = fmt::format("{} readings, {}, as {}\n", study.sweep.frequency_Hz.size(),
                                  study.sweep.format, identification.model);
  for (const Estimate& each : identification.parameters) {
    lines +=
        fmt::format("{:<28} {:>12}   95 %: {} to {}\n", each.name, formatted(each.name, each.value),
                    formatted(each.name, each.low_95), formatted(each.name, each.high_95));
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
