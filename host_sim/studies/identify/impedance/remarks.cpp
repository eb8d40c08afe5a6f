#include "host_sim/studies/identify/impedance/remarks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "host_sim/studies/identify/impedance/description.hpp"
#include "host_sim/studies/identify/impedance/scatter.hpp"

namespace sonoglide::identify::impedance {
namespace {

std::size_t readings_in_band(const Sweep& sweep, const Mode& mode) {
  return static_cast<std::size_t>(std::count_if(
      sweep.frequency_Hz.begin(), sweep.frequency_Hz.end(),
      [&](double f) { return std::abs(f - mode.resonance_Hz) <= 0.5 * mode.bandwidth_Hz; }));
}

/// Deviation of a phase residual from the one before it: what is no misfit.
double reading_to_reading(const CircuitFit& fit) {
  const Eigen::Index n = fit.at.log_magnitude.size();
  std::vector<double> steps;
  for (Eigen::Index i = n + 1; i < fit.at.residuals.size(); ++i) {
    steps.push_back(std::abs(fit.at.residuals(i) - fit.at.residuals(i - 1)));
  }
  return deviation_of_steps(std::move(steps));
}

/// Readings whose phase is beyond ±90° by more than the scatter explains.
std::size_t impossible_phases(const Sweep& sweep, const CircuitFit& fit) {
  const double scatter = 4.0 * reading_to_reading(fit);
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
                    tangent, std::abs(tangent) * 360.0 / two_pi));
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

void warn_of_other_modes(const CircuitFit& fit, std::vector<std::string>& warnings) {
  for (std::size_t i = 1; i < fit.circuit.modes.size(); ++i) {
    const Mode& mode = fit.circuit.modes[i];
    warnings.push_back(fmt::format(
        "Another mode at {} (quality factor {:.3g}, {}) is in the sweep; it is fitted and is not "
        "part of the figures.",
        shown("_Hz", mode.resonance_Hz), mode.quality(), shown("_ohm", mode.resistance_ohm())));
  }
}

/// An error φ of the phase turns the admittance as a lead of φ/(2ωC0) does beside a loss tangent of φ/2.
std::string open_phase(const Circuit& circuit) {
  const Mode& mode = circuit.modes.front();
  const double lead_ohm = circuit.lead.resistance_ohm;
  const double phase_rad =
      2.0 * lead_ohm * two_pi * mode.resonance_Hz * circuit.clamped_capacitance_F;
  return fmt::format(
      "Whether the {} in series are leads and contacts or an error of the phase: one of about "
      "{:.2g} degrees would look alike, and the motional resistance would be about {}.",
      shown("_ohm", lead_ohm), phase_rad * 360.0 / two_pi,
      shown("_ohm", mode.resistance_ohm() + lead_ohm));
}

std::string open_resistance(const Selection& selected) {
  const std::string question = "Whether leads and contacts have a series resistance";
  const std::string consequence = "The motional resistance is larger by what there is.";
  if (!selected.sweep.has_phase) {
    return question + ": magnitudes alone do not tell. " + consequence;
  }
  if (!selected.unseen_lead_ohm) {
    return question + ": no circuit with one fits. " + consequence;
  }
  return fmt::format("{} up to {}: none is seen, so the circuit has none. {}", question,
                     shown("_ohm", *selected.unseen_lead_ohm), consequence);
}

std::string open_inductance(const Selection& selected) {
  const std::string question = "Whether leads and contacts have a series inductance";
  if (!selected.unseen_inductance) {
    return question + ": " +
           (selected.sweep.has_phase ? "no circuit with one fits."
                                     : "magnitudes alone do not tell.") +
           " It would lower the resonance and change all other figures.";
  }
  const UnseenInductance& unseen = *selected.unseen_inductance;
  const double resonance_Hz = selected.fit.circuit.modes.front().resonance_Hz;
  constexpr double percent = 100.0;
  return fmt::format(
      "{} up to {}: none is seen, so the circuit has none, and the intervals do not allow for one. "
      "Each microhenry, about a metre of cable, makes the resonance come out {:+.2g} Hz off, the "
      "motional resistance {:+.2g} %, the motional capacitance {:+.2g} % and the clamped "
      "capacitance "
      "{:+.2g} %. A compensation with a short takes it out.",
      question, shown("_H", unseen.most_H), unseen.resonance_per_uH * resonance_Hz,
      percent * unseen.motional_resistance_per_uH, percent * unseen.motional_capacitance_per_uH,
      percent * unseen.clamped_capacitance_per_uH);
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

void warn_of_mode_too_many(const Selection& selected, std::vector<std::string>& warnings) {
  if (selected.mode_too_many_Hz) {
    warnings.push_back(fmt::format(
        "The limit of {} modes is reached, and another one is seen at {}: the circuit does not "
        "describe the sweep. The intervals allow for that one mode. Narrow the sweep to the "
        "resonance that is meant and its antiresonance.",
        most_modes, shown("_Hz", *selected.mode_too_many_Hz)));
  }
}

}  // namespace

std::vector<std::string> warnings_of(const Selection& selected) {
  std::vector<std::string> warnings = selected.sweep.warnings;
  warn_of_misfit(describe(selected.fit), warnings);
  warn_of_mode_too_many(selected, warnings);
  warn_of_rounding(selected.fit, warnings);
  warn_of_left_out(selected.left_out_Hz, warnings);
  warn_of_phases(selected.sweep, selected.fit, warnings);
  warn_of_sweep(selected.sweep, selected.fit, warnings);
  warn_of_other_modes(selected.fit, warnings);
  return warnings;
}

std::vector<std::string> open_questions(const std::vector<Estimate>& estimates,
                                        const Selection& selected, const MechanicalFact& fact) {
  const Sweep& sweep = selected.sweep;
  std::vector<std::string> open;
  if (!fact.known()) {
    open.emplace_back(
        "Mass, stiffness, damping and force factor: electrical data give m/Nf^2, Nf^2/Ks and "
        "c/Nf^2 alone. One mechanical fact tells them: --mass-kg, or --force-factor-N-per-V.");
  }
  if (!sweep.has_phase) {
    open.emplace_back(
        "Losses of the dielectric: magnitudes alone hardly part them from the motional resistance. "
        "A sweep with phase does.");
  }
  const LeadModel lead = selected.fit.parts.lead;
  open.push_back(has_resistance(lead) ? open_phase(selected.fit.circuit)
                                      : open_resistance(selected));
  if (!has_inductance(lead)) {
    open.push_back(open_inductance(selected));
  }
  for (const Estimate& each : estimates) {
    constexpr double twice = 2.0;
    const bool may_be_0 = each.name == "loss_tangent" || each.name.rfind("lead_", 0) == 0;
    if (!may_be_0 && !(each.high_95 < twice * each.value && each.low_95 > each.value / twice)) {
      open.push_back(fmt::format("{}: its interval goes from {} to {}.", each.name,
                                 shown(each.name, each.low_95), shown(each.name, each.high_95)));
    }
    if (each.name == "loss_tangent" && each.low_95 < 0.0 && each.high_95 > 0.0) {
      open.push_back(
          fmt::format("Whether the dielectric has losses: the loss tangent is within "
                      "{:.2g} of 0.",
                      std::max(-each.low_95, each.high_95)));
    }
  }
  return open;
}

}  // namespace sonoglide::identify::impedance
