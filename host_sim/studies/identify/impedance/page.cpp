#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host_sim/output/gnuplot.hpp"
#include "host_sim/studies/identify/impedance/report.hpp"

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
  all.erase(
      std::remove_if(all.begin(), all.end(), [&](double f) { return !(f >= low && f <= high); }),
      all.end());
  std::sort(all.begin(), all.end());
  return all;
}

/// Readings and curve over common abscissae: each has gaps where the other has its points.
struct Overlay {
  std::vector<double> x;
  std::vector<double> measured;
  std::vector<double> fitted;
};

template <class Figure>
Overlay overlay(const ImpedanceStudy& study, const Figure& figure) {
  struct Point {
    double f;
    double measured;
    double fitted;
  };
  std::vector<Point> points;
  for (std::size_t i = 0; i < study.sweep.frequency_Hz.size(); ++i) {
    const double f = study.sweep.frequency_Hz[i];
    points.push_back(
        {f, figure(study.sweep.admittance_S[i]), figure(study.fit.circuit.admittance_S(f))});
  }
  for (const double f : curve_frequencies(study)) {
    points.push_back(
        {f, std::numeric_limits<double>::quiet_NaN(), figure(study.fit.circuit.admittance_S(f))});
  }
  std::stable_sort(points.begin(), points.end(),
                   [](const Point& a, const Point& b) { return a.f < b.f; });
  Overlay result;
  for (const Point& each : points) {
    result.x.push_back(each.f);
    result.measured.push_back(each.measured);
    result.fitted.push_back(each.fitted);
  }
  return result;
}

/// A sweep of more than a decade and a half is drawn over the logarithm of the frequency.
bool is_wide(const ImpedanceStudy& study) {
  constexpr double ratio = 30.0;
  return study.sweep.frequency_Hz.back() > ratio * study.sweep.frequency_Hz.front();
}

output::Panel overlay_panel(const std::string& title, const std::string& y_label,
                            const Overlay& data) {
  output::Panel panel;
  panel.title = title;
  panel.x_label = "Frequency [Hz]";
  panel.y_label = y_label;
  panel.x = data.x;
  panel.series = {{"measured", data.measured, false, false, true}, {"fitted", data.fitted}};
  panel.group = "frequency";
  return panel;
}

output::Panel residual_panel(const ImpedanceStudy& study) {
  output::Panel panel;
  panel.title = "Residuals";
  panel.note =
      "Measured less fitted, over the fitted admittance. A pattern along the sweep is what the "
      "circuit does not describe, or drift of the instrument; the intervals allow for it.";
  panel.x_label = "Frequency [Hz]";
  panel.y_label = "Relative residual [-]";
  panel.x = study.sweep.frequency_Hz;
  const Eigen::VectorXd& all = study.fit.at.residuals;
  const auto n = static_cast<std::ptrdiff_t>(panel.x.size());
  panel.series.push_back(
      {"magnitude", std::vector<double>(all.data(), all.data() + n), false, false, true});
  if (study.sweep.has_phase) {
    panel.series.push_back({"phase [rad]", std::vector<double>(all.data() + n, all.data() + 2 * n),
                            false, false, true});
  }
  panel.group = "frequency";
  return panel;
}

output::Table figure_table(const Identification& identification) {
  output::Table table{"", {"Parameter", "Value", "95 % from", "to", "±"}, {}};
  for (const Estimate& each : identification.parameters) {
    const double half = 0.5 * (each.high_95 - each.low_95) / std::abs(each.value);
    table.rows.push_back({each.name, shown(each.name, each.value), shown(each.name, each.low_95),
                          shown(each.name, each.high_95),
                          std::isfinite(half) ? fmt::format("{:.2g} %", 100.0 * half) : "-"});
  }
  return table;
}

output::Table correlation_table(const Correlations& correlations) {
  output::Table table{"Correlations of the fitted parameters", {""}, {}};
  table.header.insert(table.header.end(), correlations.names.begin(), correlations.names.end());
  for (std::size_t i = 0; i < correlations.names.size(); ++i) {
    std::vector<std::string> row = {correlations.names[i]};
    for (const double each : correlations.rows[i]) {
      row.push_back(std::isfinite(each) ? fmt::format("{:.2f}", each) : "-");
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

output::Table open_table(const Identification& identification) {
  output::Table table{"What the data cannot tell", {}, {}};
  for (const std::string& each : identification.cannot_tell) {
    table.rows.push_back({each});
  }
  return table;
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

}  // namespace

std::string draw_circle(const ImpedanceStudy& study) {
  const Mode& mode = study.fit.circuit.modes.front();
  const auto near = [&](double f) {
    constexpr double bands = 15.0;
    return std::abs(f - mode.resonance_Hz) <= bands * mode.bandwidth_Hz;
  };
  std::string measured;
  for (std::size_t i = 0; i < study.sweep.frequency_Hz.size(); ++i) {
    const Complex y = study.sweep.admittance_S[i];
    if (near(study.sweep.frequency_Hz[i]) && study.sweep.has_phase) {
      measured += fmt::format("{:.9g} {:.9g}\n", 1e3 * y.real(), 1e3 * y.imag());
    }
  }
  std::string fitted;
  for (const double f : curve_frequencies(study)) {
    if (near(f)) {
      const Complex y = study.fit.circuit.admittance_S(f);
      fitted += fmt::format("{:.9g} {:.9g}\n", 1e3 * y.real(), 1e3 * y.imag());
    }
  }
  return output::draw_svg(
      fmt::format("$measured << EOD\nNaN NaN\n{}EOD\n$fitted << EOD\nNaN NaN\n{}EOD\n"
                  "set size ratio -1\nset grid lc rgb '#d8d8d8'\nset xzeroaxis lc rgb '#606060'\n"
                  "set xlabel 'conductance G [mS]'\nset ylabel 'susceptance B [mS]'\n"
                  "set key outside top center horizontal\n"
                  "plot $fitted using 1:2 with lines lw 2 lc rgb '#1f5fa8' title 'fitted'{}\n",
                  measured, fitted,
                  measured.empty() ? ""
                                   : ", $measured using 1:2 with points pt 7 ps 0.5 lc rgb "
                                     "'#d62728' title 'measured'"),
      620, 620);
}

output::Page page(const ImpedanceStudy& study) {
  const Identification& identification = study.identification;
  output::Section curves;
  curves.title = "Data and fit";
  curves.text = noise_text(study);
  const auto magnitude = [](Complex y) { return std::log10(1.0 / std::abs(y)); };
  curves.panels.push_back(
      overlay_panel("Impedance", "log10 |Z|/ohm [-]", overlay(study, magnitude)));
  if (study.sweep.has_phase) {
    curves.panels.push_back(
        overlay_panel("Phase of the impedance", "Phase [degrees]",
                      overlay(study, [](Complex y) { return -std::arg(y) * degrees_per_rad; })));
  }
  curves.panels.push_back(residual_panel(study));
  for (output::Panel& each : curves.panels) {
    each.logarithmic_x = is_wide(study);
  }
  curves.pictures.push_back(
      {"Admittance circle", "Within 15 band widths of the resonance.", draw_circle(study)});
  output::Section correlation;
  correlation.title = "How the parameters hang together";
  correlation.tables = {correlation_table(identification.correlations)};
  output::Page page{
      fmt::format("Impedance of {}", study.name),
      fmt::format("{} readings from {} to {}, read as {}; fitted: {}.",
                  study.sweep.frequency_Hz.size(), shown("_Hz", study.sweep.frequency_Hz.front()),
                  shown("_Hz", study.sweep.frequency_Hz.back()), study.sweep.format,
                  identification.model),
      identification.warnings,
      {figure_table(identification)},
      {curves, correlation}};
  if (!identification.cannot_tell.empty()) {
    page.tables.push_back(open_table(identification));
  }
  return page;
}

}  // namespace sonoglide::identify::impedance
