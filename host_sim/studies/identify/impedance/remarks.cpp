#include "host_sim/studies/identify/impedance/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "host_sim/studies/identify/identification.hpp"
#include "host_sim/studies/identify/impedance/selection.hpp"

namespace sonoglide::identify::impedance {
namespace {

/// Readings whose phase is beyond ±90° by more than the scatter explains.
std::size_t impossible_phases(const Sweep& sweep, const Description& description) {
  const double least = std::max(4.0 * description.scatter, 1e-3);
  return !sweep.has_phase
             ? 0
             : static_cast<std::size_t>(std::count_if(
                   sweep.admittance_S.begin(), sweep.admittance_S.end(),
                   [&](std::complex<double> y) { return y.real() < -std::abs(y) * least; }));
}

/// Whether the loss tangent is below 0 by more than scatter explains; misfit it would follow.
bool has_negative_loss(const Sweep& sweep, const CircuitFit& fit, const Description& description) {
  constexpr double many = 4.0;
  const double tangent = fit.circuit.loss_tangent;
  return sweep.has_phase && !description.fails() && tangent < 0.0 &&
         tangent < -many * std::sqrt(fit.covariance(1, 1));
}

/// Whether a part is seen; of several circuits, whichever of them is right.
bool is_certain(const CircuitFit& fit, Part part) {
  if (fit.alternatives.empty()) {
    return sees(fit, part);
  }
  const std::vector<Estimate> all = figures(fit);
  return std::any_of(all.begin(), all.end(), [&](const Estimate& each) {
    return each.name == name_of(part) && each.low_95 * each.high_95 > 0.0;
  });
}

constexpr std::size_t few = 5;

std::size_t readings_in_band(const Sweep& sweep, const Mode& mode) {
  return static_cast<std::size_t>(std::count_if(
      sweep.frequency_Hz.begin(), sweep.frequency_Hz.end(),
      [&](double f) { return std::abs(f - mode.resonance_Hz) <= 0.5 * mode.bandwidth_Hz; }));
}

std::string few_readings(std::size_t inside, const Mode& mode) {
  return fmt::format(
      "{} in the band width of {} about the resonance: resistance and quality factor rest on {}. "
      "Measure at steps of {} or finer there.",
      inside == 0   ? "No reading lies"
      : inside == 1 ? "1 reading lies"
                    : fmt::format("{} readings lie", inside),
      formatted("_Hz", mode.bandwidth_Hz),
      inside == 0   ? "the flanks"
      : inside == 1 ? "it"
                    : "them",
      formatted("_Hz", mode.bandwidth_Hz / few));
}

std::string left_out(const std::vector<double>& frequencies_Hz) {
  constexpr std::size_t most_named = 8;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(most_named, frequencies_Hz.size()); ++i) {
    names.push_back(formatted("_Hz", frequencies_Hz[i]));
  }
  const std::size_t more = frequencies_Hz.size() - names.size();
  return fmt::format("Left out as outliers, each far off the readings beside it: {}{}.",
                     fmt::join(names, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

std::string other_mode(const Mode& mode, bool is_inside) {
  return fmt::format(
      "Another mode at {} (quality factor {:.3g}, {}) is {} the sweep; it is fitted and is not "
      "part of the figures.{}",
      formatted("_Hz", mode.resonance_Hz), mode.quality(), formatted("_ohm", mode.resistance_ohm()),
      is_inside ? "in" : "just outside",
      is_inside ? ""
                : " Clamped capacitance, parallel resonance and coupling depend on it; measure a "
                  "wider sweep to determine it.");
}

/// What of a circuit stands between the modes and the reading, and what they would be behind it.
std::string described_lead(const CircuitFit& fit) {
  const Circuit& circuit = fit.circuit;
  std::vector<std::string> parts;
  append(parts,
         {{fit.parts.has(Part::rotation), fmt::format("an error of every phase by {:.3g} degrees",
                                                      circuit.rotation_rad * degrees_per_rad)},
          {fit.parts.has(Part::delay),
           fmt::format("a delay of {} between the channels", formatted("_s", circuit.delay_s))},
          {fit.parts.has(Part::lead_resistance),
           formatted("_ohm", circuit.lead.resistance_ohm) + " in series"},
          {fit.parts.has(Part::lead_inductance),
           formatted("_H", circuit.lead.inductance_H) + " in series"}});
  const Mode& mode = circuit.modes.front();
  return fmt::format("{} (motional resistance {}, resonance {})", fmt::join(parts, " with "),
                     formatted("_ohm", mode.resistance_ohm()), formatted("_Hz", mode.resonance_Hz));
}

std::string open_lead(const Selection& selected) {
  std::vector<std::string> others;
  for (const Rival& each : selected.rivals) {
    constexpr double least = 0.01;
    if (each.weight > least) {
      others.push_back(described_lead(each.fit));
    }
  }
  return fmt::format(
      "Whether leads, an error of the phase or a delay between the channels rotate the sweep: fitted "
      "is {}. {}. A compensation of the fixture (open, short, load) removes all three.",
      described_lead(selected.fit),
      others.empty() ? "No other is nearly as likely"
                     : fmt::format("About as likely: {}; the intervals allow for it",
                                   fmt::join(others, "; or ")));
}

/// On a part that is not seen.
std::string open_part(const Unseen& unseen, const Mode& mode) {
  constexpr double percent = 100.0;
  constexpr double microhenry_H = 1e-6;
  const Eigen::Vector4d off = microhenry_H * unseen.off;
  switch (unseen.part) {
    case Part::lead_resistance:
      return fmt::format(
          "Whether leads and contacts have a series resistance up to {}: none is significant, so the "
          "circuit has none. One would be part of the motional resistance given here.",
          formatted("_ohm", unseen.most));
    case Part::lead_inductance:
      return fmt::format(
          "Whether leads and contacts have a series inductance up to {}: none is significant, so the "
          "circuit has none, and the intervals do not include its effect. Each microhenry, about a "
          "metre of cable, makes the resonance come out {:+.2g} Hz off, the motional resistance "
          "{:+.2g} %, the motional capacitance {:+.2g} % and the clamped capacitance {:+.2g} %. A "
          "compensation with a short removes it.",
          formatted("_H", unseen.most), off(2) * mode.resonance_Hz, -percent * off(1),
          percent * (off(1) + off(3) - 2.0 * off(2)), percent * off(0));
    default:
      return fmt::format(
          "Whether the peak leans by up to {:.2g} band widths, as that of a resonance that depends on "
          "its current: it is not significant, so the circuit has none. Each tenth of a band width "
          "to lower frequencies makes the resonance come out {:+.2g} Hz off.",
          unseen.most, 0.1 * unseen.off(2) * mode.resonance_Hz);
  }
}

/// A drift in step with the sweep stretches the frequencies about the resonance and nothing else.
std::string open_drift(const Sweep& sweep, const Mode& mode) {
  constexpr double tenth = 0.1;
  const double off =
      tenth * mode.bandwidth_Hz / (sweep.frequency_Hz.back() - sweep.frequency_Hz.front());
  return fmt::format(
      "Whether the resonance drifted while it was swept, by heat or creep: a steady drift of {} "
      "from the first reading to the last, a tenth of the band width, makes quality factor, "
      "motional inductance and capacitance come out {:.2g} % off, and the intervals do not include "
      "it. Compare a sweep upwards with one downwards.",
      formatted("_Hz", tenth * mode.bandwidth_Hz), 100.0 * off);
}

void append_open_figure(std::vector<std::string>& sentences, const Estimate& figure) {
  constexpr double twice = 2.0;
  const std::string low = formatted(figure.name, figure.low_95);
  const std::string high = formatted(figure.name, figure.high_95);
  append(
      sentences,
      {{is_open(figure),
        fmt::format("{}: the data leave it open by more than a factor of ten, from {} to {}.",
                    figure.name, low, high)},
       {!is_open(figure) && !figure.may_be_0 &&
            !(figure.high_95 < twice * figure.value && figure.low_95 > figure.value / twice),
        fmt::format("{}: its interval goes from {} to {}.", figure.name, low, high)},
       {figure.name == name_of(Part::loss_tangent) && figure.low_95 < 0.0 && figure.high_95 > 0.0,
        fmt::format("Whether the dielectric has losses: the loss tangent is within {:.2g} of 0.",
                    std::max(-figure.low_95, figure.high_95))}});
}

}  // namespace

std::vector<std::string> warnings_of(const Selection& selected) {
  const Sweep& sweep = selected.sweep;
  const CircuitFit& fit = selected.fit;
  const Circuit& circuit = fit.circuit;
  const Mode& mode = circuit.modes.front();
  const Description& description = fit.description;
  const std::size_t impossible = impossible_phases(sweep, description);
  const std::size_t inside = readings_in_band(sweep, mode);
  constexpr double least_of_ultrasound_Hz = 1000.0;
  std::vector<std::string> warnings = sweep.warnings;
  append(
      warnings,
      {{mode.resonance_Hz < least_of_ultrasound_Hz,
        fmt::format("The resonance is at {}, which is far below ultrasound. If the numbers of the "
                    "file are in kHz, give its frequency that unit.",
                    formatted("_Hz", mode.resonance_Hz))},
       {description.fails(),
        fmt::format("The circuit does not describe the sweep: what it leaves is {:.2g} % of the "
                    "readings (root mean square), and they scatter by {:.2g} % from one to the "
                    "next. The intervals allow for the misfit, but a circuit that is not the right "
                    "one may be further off. Narrow the sweep to one resonance and its "
                    "antiresonance, or see to the fixture.",
                    100.0 * description.residual, 100.0 * description.scatter)},
       {fit.parts.has(Part::lean),
        fmt::format("The peak is not that of one linear mode: it leans by {:.2g} band widths to {} "
                    "frequencies, from {} at a small current to {} at the largest of the sweep. "
                    "The figures are those at a small current, by a resonance that goes with the "
                    "square of the current. Sweep with less voltage.",
                    std::abs(circuit.lean), circuit.lean > 0.0 ? "lower" : "higher",
                    formatted("_Hz", mode.resonance_Hz),
                    formatted("_Hz", mode.resonance_Hz - circuit.lean * mode.bandwidth_Hz))},
       {is_certain(fit, Part::rotation),
        fmt::format("The phases are off by {:.3g} degrees all over the sweep; the fit takes that "
                    "out. It is an error of the instrument or the fixture; compensate it (open, "
                    "short, load).",
                    circuit.rotation_rad * degrees_per_rad)},
       {is_certain(fit, Part::delay),
        fmt::format(
            "The phases are off in proportion to the frequency, by {:.3g} degrees at the "
            "resonance: the voltage is read {} {} than the current. The fit takes that out. "
            "Compensate the instrument with a known resistor as load.",
            circuit.delay_s * mode.resonance_Hz * 360.0, formatted("_s", std::abs(circuit.delay_s)),
            circuit.delay_s > 0.0 ? "later" : "earlier")},
       {is_rounding(fit.at),
        fmt::format("The readings follow the circuit to {:.1g}, as computed ones do: the intervals "
                    "are those of readings rounded to {:.1g}.",
                    rounding, rounding)},
       {!selected.left_out_Hz.empty(), left_out(selected.left_out_Hz)},
       {impossible > 0,
        fmt::format("{} of {} readings have a phase beyond 90 degrees: no passive part has one. It "
                    "is an error of the fixture or of its compensation; compensate it (open, "
                    "short, load) and measure again.",
                    impossible, sweep.frequency_Hz.size())},
       {has_negative_loss(sweep, fit, description),
        fmt::format("The loss tangent comes out negative, {:.3g}: the phase is off by about {:.2g} "
                    "degrees, which is the fixture's error.",
                    circuit.loss_tangent, std::abs(circuit.loss_tangent) * degrees_per_rad)},
       {inside < few, few_readings(inside, mode)},
       {circuit.antiresonance_Hz() > sweep.frequency_Hz.back(),
        fmt::format("The parallel resonance at {} is above the sweep, which ends at {}: the "
                    "clamped capacitance and the coupling rest on the flank alone.",
                    formatted("_Hz", circuit.antiresonance_Hz()),
                    formatted("_Hz", sweep.frequency_Hz.back()))}});
  for (std::size_t i = 1; i < circuit.modes.size(); ++i) {
    warnings.push_back(other_mode(circuit.modes[i], is_in(sweep, circuit.modes[i])));
  }
  return warnings;
}

std::vector<std::string> open_questions(const std::vector<Estimate>& estimates,
                                        const Selection& selected, const MechanicalFact& fact) {
  const Sweep& sweep = selected.sweep;
  const std::vector<Mode>& modes = selected.fit.circuit.modes;
  std::vector<std::string> open;
  append(
      open,
      {{!fact.known(),
        "Mass, stiffness, damping and force factor: electrical data give m/Nf^2, Nf^2/Ks and "
        "c/Nf^2 alone. One mechanical fact determines them: --mass-kg, or --force-factor-N-per-V."},
       {!sweep.has_phase,
        "Losses of the dielectric: magnitudes alone hardly separate them from the motional "
        "resistance. A sweep with phase does."},
       {sees_turned_phase(selected.fit) || !selected.rivals.empty(), open_lead(selected)}});
  for (const Unseen& each : selected.unseen) {
    open.push_back(open_part(each, modes.front()));
  }
  append(
      open,
      {{!sweep.has_phase,
        "Whether leads and contacts have a series resistance: magnitudes alone do not show it. It "
        "would be part of the motional resistance given here."},
       {!sweep.has_phase,
        "Whether leads and contacts have a series inductance: magnitudes alone do not show it. It "
        "would lower the resonance and change all other figures."},
       {!sweep.has_phase,
        "Whether the errors of neighbouring readings are correlated: magnitudes alone show little of "
        "it. If they are, the intervals should be about half as wide again. A sweep with phase, or "
        "with more readings, shows more."},
       {true, open_drift(sweep, modes.front())},
       {std::all_of(modes.begin(), modes.end(),
                    [&](const Mode& each) { return is_in(sweep, each); }),
        "Whether another mode lies just outside the sweep: it would shift clamped capacitance, "
        "parallel resonance and coupling by more than their intervals. A wider sweep shows it."}});
  for (const Estimate& each : estimates) {
    append_open_figure(open, each);
  }
  return open;
}

}  // namespace sonoglide::identify::impedance
