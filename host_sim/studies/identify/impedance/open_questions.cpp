#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "host_sim/studies/identify/impedance/figures.hpp"
#include "host_sim/studies/identify/impedance/plausible.hpp"
#include "host_sim/studies/identify/impedance/remarks.hpp"
#include "host_sim/studies/identify/impedance/uncertainty.hpp"

namespace sonoglide::identify::impedance {
namespace {

/// What of a circuit stands between the modes and the reading, and what they would be behind it.
std::string described_lead(const CircuitFit& fit) {
  const Circuit& circuit = fit.circuit;
  std::vector<std::string> parts;
  if (fit.parts.has(Part::rotation)) {
    parts.push_back(fmt::format("an error of every phase by {:.3g} degrees",
                                circuit.rotation_rad * degrees_per_rad));
  }
  if (fit.parts.has(Part::lead_resistance)) {
    parts.push_back(fmt::format("{} in series", shown("_ohm", circuit.lead.resistance_ohm)));
  }
  if (fit.parts.has(Part::lead_inductance)) {
    parts.push_back(fmt::format("{} in series", shown("_H", circuit.lead.inductance_H)));
  }
  const Mode& mode = circuit.modes.front();
  return fmt::format("{} (motional resistance {}, resonance {})", fmt::join(parts, " with "),
                     shown("_ohm", mode.resistance_ohm()), shown("_Hz", mode.resonance_Hz));
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
      "Whether leads or an error of the phase turn the sweep: fitted is {}. {}. A compensation of "
      "the fixture (open, short, load) takes both out.",
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
          "Whether leads and contacts have a series resistance up to {}: none is seen, so the "
          "circuit has none. The motional resistance is larger by what there is.",
          shown("_ohm", unseen.most));
    case Part::lead_inductance:
      return fmt::format(
          "Whether leads and contacts have a series inductance up to {}: none is seen, so the "
          "circuit has none, and the intervals do not allow for one. Each microhenry, about a "
          "metre of cable, makes the resonance come out {:+.2g} Hz off, the motional resistance "
          "{:+.2g} %, the motional capacitance {:+.2g} % and the clamped capacitance {:+.2g} %. A "
          "compensation with a short takes it out.",
          shown("_H", unseen.most), off(2) * mode.resonance_Hz, -percent * off(1),
          percent * (off(1) + off(3) - 2.0 * off(2)), percent * off(0));
    default:
      return fmt::format(
          "Whether the peak leans by up to {:.2g} band widths, as that of a resonance that goes "
          "with its current: it is not seen, so the circuit has none. Each tenth of a band width "
          "to lower frequencies makes the resonance come out {:+.2g} Hz off.",
          unseen.most, 0.1 * unseen.off(2) * mode.resonance_Hz);
  }
}

/// A drift in step with the sweep stretches the frequencies about the resonance and nothing else.
std::string open_drift(const Selection& selected) {
  const std::vector<double>& all = selected.sweep.frequency_Hz;
  const Mode& mode = selected.fit.circuit.modes.front();
  constexpr double tenth = 0.1;
  const double off = tenth * mode.bandwidth_Hz / (all.back() - all.front());
  return fmt::format(
      "Whether the resonance drifted while it was swept, by heat or creep: a steady drift of {} "
      "from the first reading to the last, a tenth of the band width, makes quality factor, "
      "motional inductance and capacitance come out {:.2g} % off, and the intervals do not allow "
      "for it. A sweep to lower frequencies beside one to higher ones tells.",
      shown("_Hz", tenth * mode.bandwidth_Hz), 100.0 * off);
}

}  // namespace

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
  if (sees_lead_or_rotation(selected.fit)) {
    open.push_back(open_lead(selected));
  }
  for (const Unseen& each : selected.unseen) {
    open.push_back(open_part(each, selected.fit.circuit.modes.front()));
  }
  if (!sweep.has_phase) {
    open.emplace_back(
        "Whether leads and contacts have a series resistance: magnitudes alone do not tell. The "
        "motional resistance is larger by what there is.");
    open.emplace_back(
        "Whether leads and contacts have a series inductance: magnitudes alone do not tell. It "
        "would lower the resonance and change all other figures.");
  }
  open.push_back(open_drift(selected));
  const std::vector<Mode>& modes = selected.fit.circuit.modes;
  if (std::all_of(modes.begin(), modes.end(),
                  [&](const Mode& each) { return is_in(sweep, each); })) {
    open.emplace_back(
        "Whether another mode lies just outside the sweep: it would shift clamped capacitance, "
        "parallel resonance and coupling by more than their intervals. A wider sweep tells.");
  }
  for (const Estimate& each : estimates) {
    constexpr double twice = 2.0;
    if (is_open(each)) {
      open.push_back(
          fmt::format("{}: the data leave it open by more than a factor of ten, from {} to {}.",
                      each.name, shown(each.name, each.low_95), shown(each.name, each.high_95)));
    } else if (!may_be_0(each) &&
               !(each.high_95 < twice * each.value && each.low_95 > each.value / twice)) {
      open.push_back(fmt::format("{}: its interval goes from {} to {}.", each.name,
                                 shown(each.name, each.low_95), shown(each.name, each.high_95)));
    }
    if (each.name == "loss_tangent" && each.low_95 < 0.0 && each.high_95 > 0.0) {
      open.push_back(
          fmt::format("Whether the dielectric has losses: the loss tangent is within {:.2g} of 0.",
                      std::max(-each.low_95, each.high_95)));
    }
  }
  return open;
}

}  // namespace sonoglide::identify::impedance
