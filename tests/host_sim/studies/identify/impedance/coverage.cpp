#include "coverage.hpp"

#include <random>

#include "host_sim/loop/failure.hpp"
#include "host_sim/studies/identify/impedance/figures.hpp"
#include "host_sim/studies/identify/impedance/selection.hpp"

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
    try {
      found = figures(select_circuit(made.sweep).fit);
    } catch (const loop::ComputationError&) {
      found.clear();
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
      ++all[i].sweeps;
      all[i].covered +=
          i < found.size() && truth[i] >= found[i].low_95 && truth[i] <= found[i].high_95 ? 1 : 0;
    }
  }
  return all;
}

}  // namespace sonoglide::identify::impedance
