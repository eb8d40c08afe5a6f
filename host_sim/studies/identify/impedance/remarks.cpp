#include "host_sim/studies/identify/impedance/remarks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "host_sim/studies/identify/impedance/description.hpp"
#include "host_sim/studies/identify/impedance/figures.hpp"
#include "host_sim/studies/identify/impedance/plausible.hpp"
#include "host_sim/studies/identify/impedance/uncertainty.hpp"

namespace sonoglide::identify::impedance {
namespace {

std::size_t readings_in_band(const Sweep& sweep, const Mode& mode) {
  return static_cast<std::size_t>(std::count_if(
      sweep.frequency_Hz.begin(), sweep.frequency_Hz.end(),
      [&](double f) { return std::abs(f - mode.resonance_Hz) <= 0.5 * mode.bandwidth_Hz; }));
}

/// Readings whose phase is beyond ±90° by more than the scatter explains.
std::size_t impossible_phases(const Sweep& sweep, const CircuitFit& fit) {
  const double scatter = 4.0 * describe(fit).scatter;
  return static_cast<std::size_t>(std::count_if(
      sweep.admittance_S.begin(), sweep.admittance_S.end(),
      [&](std::complex<double> y) { return y.real() < -std::abs(y) * std::max(scatter, 1e-3); }));
}

void warn_of_phases(const Sweep& sweep, const CircuitFit& fit, std::vector<std::string>& warnings) {
  if (!sweep.has_phase) {
    return;
  }
  const std::size_t impossible = impossible_phases(sweep, fit);
  if (impossible > 0) {
    warnings.push_back(
        fmt::format("{} of {} readings have a phase beyond 90 degrees: no passive part has one. "
                    "It is an error of the fixture or of its compensation; compensate it (open, "
                    "short, load) and measure again.",
                    impossible, sweep.frequency_Hz.size()));
  }
  if (describe(fit).fails()) {
    return;  // Then the loss tangent follows the misfit.
  }
  const double deviation = std::sqrt(fit.covariance(1, 1));
  const double tangent = fit.circuit.loss_tangent;
  constexpr double many = 4.0;
  if (tangent < -many * deviation && tangent < 0.0) {
    warnings.push_back(
        fmt::format("The loss tangent comes out negative, {:.3g}: the phase is off by about {:.2g} "
                    "degrees, which is the fixture's error.",
                    tangent, std::abs(tangent) * degrees_per_rad));
  }
}

void warn_of_sweep(const Sweep& sweep, const CircuitFit& fit, std::vector<std::string>& warnings) {
  const Mode& mode = fit.circuit.modes.front();
  const std::size_t inside = readings_in_band(sweep, mode);
  constexpr std::size_t few = 5;
  if (inside < few) {
    warnings.push_back(fmt::format(
        "{} in the band width of {} about the resonance: resistance and quality factor rest on {}. "
        "Measure at steps of {} or finer there.",
        inside == 0   ? "No reading lies"
        : inside == 1 ? "1 reading lies"
                      : fmt::format("{} readings lie", inside),
        shown("_Hz", mode.bandwidth_Hz),
        inside == 0   ? "the flanks"
        : inside == 1 ? "it"
                      : "them",
        shown("_Hz", mode.bandwidth_Hz / few)));
  }
  const double parallel_Hz = fit.circuit.antiresonance_Hz();
  if (parallel_Hz > sweep.frequency_Hz.back()) {
    warnings.push_back(fmt::format(
        "The parallel resonance at {} is above the sweep, which ends at {}: the clamped "
        "capacitance and the coupling rest on the flank alone.",
        shown("_Hz", parallel_Hz), shown("_Hz", sweep.frequency_Hz.back())));
  }
}

void warn_of_misfit(const Description& description, std::vector<std::string>& warnings) {
  if (description.fails()) {
    warnings.push_back(fmt::format(
        "The circuit does not describe the sweep: what it leaves is {:.2g} % of the readings (root "
        "mean square), and they scatter by {:.2g} % from one to the next. The intervals allow for "
        "the misfit, but a circuit that is not the right one may be further off. Narrow the sweep "
        "to one resonance and its antiresonance, or see to the fixture.",
        100.0 * description.residual, 100.0 * description.scatter));
  }
}

void warn_of_left_out(const std::vector<double>& left_out_Hz, std::vector<std::string>& warnings) {
  if (left_out_Hz.empty()) {
    return;
  }
  constexpr std::size_t most_named = 8;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(most_named, left_out_Hz.size()); ++i) {
    names.push_back(shown("_Hz", left_out_Hz[i]));
  }
  const std::size_t more = left_out_Hz.size() - names.size();
  warnings.push_back(fmt::format("Left out, as standing alone far off the readings beside: {}{}.",
                                 fmt::join(names, ", "),
                                 more > 0 ? fmt::format(" and {} more", more) : ""));
}

void warn_of_other_modes(const Selection& selected, std::vector<std::string>& warnings) {
  const std::vector<Mode>& modes = selected.fit.circuit.modes;
  for (std::size_t i = 1; i < modes.size(); ++i) {
    const bool is_inside = is_in(selected.sweep, modes[i]);
    warnings.push_back(fmt::format(
        "Another mode at {} (quality factor {:.3g}, {}) is {} the sweep; it is fitted and is not "
        "part of the figures.{}",
        shown("_Hz", modes[i].resonance_Hz), modes[i].quality(),
        shown("_ohm", modes[i].resistance_ohm()), is_inside ? "in" : "just outside",
        is_inside ? ""
                  : " Clamped capacitance, parallel resonance and coupling rest on what it is "
                    "taken for; a wider sweep tells."));
  }
}

void warn_of_rounding(const CircuitFit& fit, std::vector<std::string>& warnings) {
  if (is_rounding(fit.at)) {
    warnings.push_back(
        fmt::format("The readings follow the circuit to {:.1g}, as computed ones do: the intervals "
                    "are those of "
                    "readings rounded to {:.1g}.",
                    rounding, rounding));
  }
}

void warn_of_lean(const CircuitFit& fit, std::vector<std::string>& warnings) {
  if (!fit.parts.has(Part::lean)) {
    return;
  }
  const Mode& mode = fit.circuit.modes.front();
  const double lean = fit.circuit.lean;
  warnings.push_back(fmt::format(
      "The peak is not that of one linear mode: it leans by {:.2g} band widths to {} frequencies, "
      "from {} at a small current to {} at the largest of the sweep. The figures are those at a "
      "small current, by a resonance that goes with the square of the current. Sweep with less "
      "voltage.",
      std::abs(lean), lean > 0.0 ? "lower" : "higher", shown("_Hz", mode.resonance_Hz),
      shown("_Hz", mode.resonance_Hz - lean * mode.bandwidth_Hz)));
}

void warn_of_rotation(const CircuitFit& fit, std::vector<std::string>& warnings) {
  if (sees_rotation(fit)) {
    warnings.push_back(fmt::format(
        "The phases are off by {:.3g} degrees all over the sweep; the fit takes that out. It is "
        "an error of the instrument or the fixture; compensate it (open, short, load).",
        fit.circuit.rotation_rad * degrees_per_rad));
  }
}

}  // namespace

std::vector<std::string> warnings_of(const Selection& selected) {
  std::vector<std::string> warnings = selected.sweep.warnings;
  warn_of_misfit(describe(selected.fit), warnings);
  warn_of_lean(selected.fit, warnings);
  warn_of_rotation(selected.fit, warnings);
  warn_of_rounding(selected.fit, warnings);
  warn_of_left_out(selected.left_out_Hz, warnings);
  warn_of_phases(selected.sweep, selected.fit, warnings);
  warn_of_sweep(selected.sweep, selected.fit, warnings);
  warn_of_other_modes(selected, warnings);
  return warnings;
}

}  // namespace sonoglide::identify::impedance
