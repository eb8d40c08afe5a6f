#include "coverage.hpp"

#include <algorithm>
#include <random>

#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/studies/identify/impedance/selection.hpp"
#include "host_sim/studies/identify/impedance/study.hpp"

namespace sonoglide::identify::impedance {
namespace {

std::vector<double> true_values(const Circuit& truth) {
  const Mode& mode = truth.modes.front();
  return {truth.clamped_capacitance_F,
          mode.resistance_ohm(),
          mode.inductance_H(),
          mode.capacitance_F(),
          mode.resonance_Hz,
          truth.antiresonance_Hz(),
          mode.quality(),
          truth.coupling()};
}

bool says(const std::vector<std::string>& all, const std::string& what) {
  return std::any_of(all.begin(), all.end(),
                     [&](const std::string& each) { return each.find(what) != std::string::npos; });
}

/// Whether the sentences beside the figures name the defect that this kind of sweep has and that is not
/// fitted, or several circuits that are about as likely.
bool is_told(const Kind& kind, const Selection& selected, const std::vector<Estimate>& found) {
  const std::vector<std::string> open = open_questions(found, selected, {});
  return says(open, "About as likely") ||
         (kind.trait == Trait::drift && says(open, "Whether the resonance drifted")) ||
         (kind.error == Error::correlated && says(open, "neighbouring readings are correlated")) ||
         (kind.trait == Trait::lead && says(open, "have a series inductance up to")) ||
         (kind.trait == Trait::lead_delay && says(open, "have a series resistance up to")) ||
         (kind.second == Second::beside && (says(open, "just outside the sweep") ||
                                            says(warnings_of(selected), "just outside the sweep")));
}

}  // namespace

std::vector<Coverage> coverage(const Kind& kind, int sweeps, unsigned seed) {
  constexpr int readings = 80;
  std::mt19937_64 random(seed);
  std::vector<Coverage> all = {{"clamped_capacitance_F"},  {"motional_resistance_ohm"},
                               {"motional_inductance_H"},  {"motional_capacitance_F"},
                               {"resonance_frequency_Hz"}, {"antiresonance_frequency_Hz"},
                               {"quality_factor"},         {"coupling"}};
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const Synthetic made = synthetic(kind, readings, random);
    const std::vector<double> truth = true_values(made.truth);
    std::vector<Estimate> found;
    bool told = false;
    try {
      const Selection selected = select_circuit(made.sweep);
      found = figures(selected.fit);
      told = is_told(kind, selected, found);
    } catch (const loop::ComputationError&) {
      found.clear();
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool is_covered =
          i < found.size() && truth[i] >= found[i].low_95 && truth[i] <= found[i].high_95;
      ++all[i].sweeps;
      all[i].covered += is_covered ? 1 : 0;
      all[i].told += told ? 1 : 0;
      all[i].told_and_covered += told && is_covered ? 1 : 0;
    }
  }
  return all;
}

}  // namespace sonoglide::identify::impedance
