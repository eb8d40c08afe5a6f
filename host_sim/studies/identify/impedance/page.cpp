#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "host_sim/output/gnuplot.hpp"
#include "host_sim/studies/identify/impedance/report.hpp"
#include "host_sim/studies/identify/report.hpp"

namespace sonoglide::identify::impedance {
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
output::Panel fit_panel(const ImpedanceStudy& study, const std::string& title,
                        const std::string& y_label, double (*figure)(Complex admittance_S)) {
  const auto fitted = [&](double frequency_Hz) {
    return figure(study.fit.circuit.admittance_S(frequency_Hz));
  };
  std::vector<Place> places;
  for (std::size_t i = 0; i < study.sweep.frequency_Hz.size(); ++i) {
    const double f = study.sweep.frequency_Hz[i];
    places.push_back({f, figure(study.sweep.admittance_S[i]), {fitted(f)}});
  }
  for (const double f : curve_frequencies(study)) {
    places.push_back({f, std::numeric_limits<double>::quiet_NaN(), {fitted(f)}});
  }
  output::Panel panel;
  panel.title = title;
  panel.y_label = y_label;
  draw_fit(panel, std::move(places), {"fitted"});
  return panel;
}

output::Panel residual_panel(const ImpedanceStudy& study) {
  output::Panel panel;
  panel.title = "Residuals";
  panel.note =
      "The logarithm of measured over fitted admittance. A pattern along the sweep is what the "
      "circuit does not describe, or drift of the instrument; the intervals allow for it.";
  panel.y_label = "Relative residual [-]";
  panel.x = study.sweep.frequency_Hz;
  const double* all = study.fit.at.residuals.data();
  const auto n = static_cast<std::ptrdiff_t>(panel.x.size());
  panel.series = {dots("magnitude", {all, all + n})};
  if (study.sweep.has_phase) {
    panel.series.push_back(dots("phase [rad]", {all + n, all + 2 * n}));
  }
  return panel;
}

/// A sweep of more than a decade and a half is drawn over the logarithm of the frequency.
std::vector<output::Panel> panels(const ImpedanceStudy& study) {
  std::vector<output::Panel> all = {
      fit_panel(study, "Impedance", "log10 |Z|/ohm [-]",
                [](Complex y) { return std::log10(1.0 / std::abs(y)); })};
  if (study.sweep.has_phase) {
    all.push_back(fit_panel(study, "Phase of the impedance", "Phase [degrees]",
                            [](Complex y) { return -std::arg(y) * degrees_per_rad; }));
  }
  all.push_back(residual_panel(study));
  constexpr double wide = 30.0;
  for (output::Panel& each : all) {
    each.x_label = "Frequency [Hz]";
    each.group = "frequency";
    each.logarithmic_x = study.sweep.frequency_Hz.back() > wide * study.sweep.frequency_Hz.front();
  }
  return all;
}

std::string noise_text(const ImpedanceStudy& study) {
  const Noise& noise = study.fit.noise;
  std::string words = fmt::format(
      "Residuals are {:.3g} of the fitted admittance (rms). Their size goes with the admittance to "
      "the power {:.2g} (0: constant in admittance, 1: relative, 2: constant in impedance).",
      study.identification.residual_rms, noise.exponent);
  if (noise.correlated_share > 0.0) {
    words += fmt::format(
        " {:.0f} % of their variance hangs together along the sweep, by {:.2g} from reading to "
        "reading: misfit of {:.3g}. The intervals are wider for it.",
        100.0 * noise.correlated_share, noise.memory, study.identification.misfit);
  } else {
    words += " No correlation along the sweep is seen.";
  }
  return words;
}

/// Measured and fitted admittance in the complex plane, an SVG document.
std::string draw_circle(const ImpedanceStudy& study) {
  const Mode& mode = study.fit.circuit.modes.front();
  const auto line = [&](double frequency_Hz, Complex y) {
    constexpr double bands = 15.0;
    return std::abs(frequency_Hz - mode.resonance_Hz) <= bands * mode.bandwidth_Hz
               ? output::data_point(1e3 * y.real(), 1e3 * y.imag())
               : std::string();
  };
  std::string measured;
  for (std::size_t i = 0; study.sweep.has_phase && i < study.sweep.frequency_Hz.size(); ++i) {
    measured += line(study.sweep.frequency_Hz[i], study.sweep.admittance_S[i]);
  }
  std::string fitted;
  for (const double f : curve_frequencies(study)) {
    fitted += line(f, study.fit.circuit.admittance_S(f));
  }
  return output::draw_svg(
      output::data_block("measured", "NaN NaN\n" + measured) +
          output::data_block("fitted", "NaN NaN\n" + fitted) +
          fmt::format(
              "set size ratio -1\nset grid lc rgb '#d8d8d8'\nset xzeroaxis lc rgb '#606060'\n"
              "set xlabel 'conductance G [mS]'\nset ylabel 'susceptance B [mS]'\n"
              "set key outside top center horizontal\n"
              "plot $fitted using 1:2 with lines lw 2 lc rgb '#1f5fa8' title 'fitted'{}\n",
              measured.empty() ? ""
                               : ", $measured using 1:2 with points pt 7 ps 0.5 lc rgb "
                                 "'#d62728' title 'measured'"),
      620, 620);
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
  page.sections = {
      {"Data and fit",
       noise_text(study),
       panels(study),
       {{"Admittance circle", "Within 15 band widths of the resonance.", draw_circle(study)}}},
      {"How the parameters hang together",
       "",
       {},
       {},
       {correlation_table(identification.correlations)}}};
  return page;
}

}  // namespace sonoglide::identify::impedance
