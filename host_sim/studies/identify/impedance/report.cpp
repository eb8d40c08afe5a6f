#include "host_sim/studies/identify/impedance/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "host_sim/output/chart.hpp"
#include "host_sim/output/number.hpp"
#include "host_sim/studies/identify/identification.hpp"

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

namespace {

using Complex = std::complex<double>;

/// Frequencies of the curve of the fit, with many about each mode, within the sweep.
std::vector<double> curve_frequencies(const ImpedanceStudy& study) {
  const double low = study.sweep.frequency_Hz.front();
  const double high = study.sweep.frequency_Hz.back();
  std::vector<double> all;
  constexpr int even = 400;
  for (int i = 0; i <= even; ++i) {
    all.push_back(low * std::pow(high / low, static_cast<double>(i) / even));
  }
  constexpr int about = 300;
  for (const Mode& mode : study.fit.circuit.modes) {
    for (int i = -about; i <= about; ++i) {
      // Equal angles on the circle.
      const double angle = 0.5 * two_pi / 2.0 * i / (about + 1.0);
      all.push_back(mode.resonance_Hz + 0.5 * mode.bandwidth_Hz * std::tan(angle));
    }
  }
  std::sort(all.begin(), all.end());
  // The even ones may round to beside the ends.
  return {std::lower_bound(all.begin(), all.end(), low),
          std::upper_bound(all.begin(), all.end(), high)};
}

/// Readings and fit as one figure of the admittance.
output::Chart fit_chart(const ImpedanceStudy& study, const std::string& title,
                        const std::string& y_label, double (*figure)(Complex admittance_S)) {
  output::Curve measured = dots("measured", study.sweep.frequency_Hz);
  for (const Complex each : study.sweep.admittance_S) {
    measured.y.push_back(figure(each));
  }
  output::Curve fitted{"fitted", {}, output::Line::joined, curve_frequencies(study)};
  for (const double f : fitted.x) {
    fitted.y.push_back(figure(study.fit.circuit.admittance_S(f)));
  }
  return {title, "", {}, {y_label}, {}, {std::move(measured), std::move(fitted)}};
}

output::Chart residual_chart(const ImpedanceStudy& study) {
  output::Chart chart;
  chart.title = "Residuals";
  chart.note =
      "The logarithm of measured over fitted admittance. A pattern along the sweep is what the "
      "circuit does not describe, or drift of the instrument; the intervals allow for it.";
  chart.y_axis.label = "Relative residual [-]";
  chart.y_axis.has_zero = true;
  const std::vector<double>& x = study.sweep.frequency_Hz;
  const double* all = study.fit.at.residuals.data();
  const auto n = static_cast<std::ptrdiff_t>(x.size());
  chart.curves = {dots("magnitude", x, {all, all + n})};
  if (study.sweep.has_phase) {
    chart.curves.push_back(dots("phase [rad]", x, {all + n, all + 2 * n}));
  }
  return chart;
}

std::string noise_text(const ImpedanceStudy& study) {
  const Noise& noise = study.fit.noise;
  std::string words = fmt::format(
      "Residuals are {:.3g} of the fitted admittance (rms). Their size goes with the admittance to "
      "the power {:.2g} (0: constant in admittance, 1: relative, 2: constant in impedance).",
      study.identification.residual_rms, noise.exponent);
  if (noise.correlated_share > 0.0) {
    words += fmt::format(
        " {:.0f} % of their variance is correlated along the sweep, by {:.2g} from reading to "
        "reading: misfit of {:.3g}. The intervals include it.",
        100.0 * noise.correlated_share, noise.memory, study.identification.misfit);
  } else {
    words += " No correlation along the sweep is significant.";
  }
  return words;
}

/// Measured and fitted admittance in the complex plane.
output::Chart circle_chart(const ImpedanceStudy& study) {
  const Mode& mode = study.fit.circuit.modes.front();
  output::Curve measured = dots("measured");
  output::Curve fitted{"fitted", {}};
  const auto add = [&](output::Curve& curve, double frequency_Hz, Complex admittance_S) {
    constexpr double bands = 15.0;
    if (std::abs(frequency_Hz - mode.resonance_Hz) <= bands * mode.bandwidth_Hz) {
      curve.x.push_back(admittance_S.real());
      curve.y.push_back(admittance_S.imag());
    }
  };
  for (std::size_t i = 0; study.sweep.has_phase && i < study.sweep.frequency_Hz.size(); ++i) {
    add(measured, study.sweep.frequency_Hz[i], study.sweep.admittance_S[i]);
  }
  for (const double f : curve_frequencies(study)) {
    add(fitted, f, study.fit.circuit.admittance_S(f));
  }
  output::Chart chart{"Admittance circle",
                      "Within 15 band widths of the resonance.",
                      {"Conductance G [S]"},
                      {"Susceptance B [S]"},
                      {},
                      {}};
  if (!measured.y.empty()) {
    chart.curves.push_back(std::move(measured));
  }
  chart.curves.push_back(std::move(fitted));
  chart.equal_scales = true;
  return chart;
}

/// A sweep of more than a decade and a half is drawn over the logarithm of the frequency.
std::vector<output::Chart> charts(const ImpedanceStudy& study) {
  std::vector<output::Chart> all = {
      fit_chart(study, "Impedance", "|Z| [ohm]", [](Complex y) { return 1.0 / std::abs(y); })};
  all.front().y_axis.logarithmic = true;
  if (study.sweep.has_phase) {
    all.push_back(fit_chart(study, "Phase of the impedance", "Phase [degrees]",
                            [](Complex y) { return -std::arg(y) * degrees_per_rad; }));
  }
  all.push_back(residual_chart(study));
  constexpr double wide = 30.0;
  for (output::Chart& each : all) {
    each.x_axis.label = "Frequency [Hz]";
    each.group = "frequency";
    each.x_axis.logarithmic =
        study.sweep.frequency_Hz.back() > wide * study.sweep.frequency_Hz.front();
  }
  all.push_back(circle_chart(study));
  return all;
}

}  // namespace

output::Page page(const ImpedanceStudy& study) {
  const Identification& identification = study.identification;
  output::Page page;
  page.title = fmt::format("Impedance of {}", study.name);
  page.lead = fmt::format(
      "{} readings from {} to {}, read as {}; fitted: {}.", study.sweep.frequency_Hz.size(),
      formatted("_Hz", study.sweep.frequency_Hz.front()),
      formatted("_Hz", study.sweep.frequency_Hz.back()), study.sweep.format, identification.model);
  page.warnings = identification.warnings;
  page.tables = {figure_table(identification.parameters)};
  if (!identification.cannot_tell.empty()) {
    page.tables.push_back(sentence_table("What the data cannot tell", identification.cannot_tell));
  }
  page.sections = {{"Data and fit", noise_text(study), charts(study)},
                   {"Correlations of the fitted parameters",
                    "",
                    {},
                    {correlation_table(identification.correlations)}}};
  return page;
}

}  // namespace sonoglide::identify::impedance
