#include "host_sim/studies/identify/impedance/selection.hpp"

#include <algorithm>
#include <cmath>

namespace sonoglide::identify::impedance {
namespace {

struct Bounds {
  Part part;
  double least;
  double most;
};

bool has_plausible_parts(const Sweep& sweep, const CircuitFit& fit) {
  constexpr double unbounded = 1e300;
  const Circuit& circuit = fit.circuit;
  const Bounds all[] = {
      {Part::loss_tangent, sweep.has_phase ? -unbounded : 0.0, unbounded},
      {Part::rotation, -0.26, 0.26},
      {Part::lead_resistance, 0.0, 0.25 * circuit.modes.front().resistance_ohm()},
      {Part::lead_inductance, 0.0, most_inductance_H(circuit)},
      {Part::lean, -3.0, 3.0},
  };
  const Eigen::VectorXd p = to_vector(circuit);
  return std::all_of(std::begin(all), std::end(all), [&](const Bounds& each) {
    const double value = p(index_of(each.part));
    return !fit.parts.has(each.part) || (value > each.least && value < each.most);
  });
}

bool is_plausible_inside(const Sweep& sweep, const Mode& mode) {
  constexpr std::ptrdiff_t fewest = 2;
  return mode.bandwidth_Hz < 2.0 * (sweep.frequency_Hz.back() - sweep.frequency_Hz.front()) &&
         mode.quality() > 0.5 &&
         std::count_if(sweep.frequency_Hz.begin(), sweep.frequency_Hz.end(), [&](double f) {
           return std::abs(f - mode.resonance_Hz) < mode.bandwidth_Hz;
         }) >= fewest;
}

bool is_plausible_beside(const Sweep& sweep, const Mode& first, const Mode& mode) {
  const double reach_Hz = 0.5 * (sweep.frequency_Hz.back() - sweep.frequency_Hz.front());
  const double quality = mode.quality() / first.quality();
  return mode.resonance_Hz > sweep.frequency_Hz.front() - reach_Hz &&
         mode.resonance_Hz < sweep.frequency_Hz.back() + reach_Hz && quality > 0.25 &&
         quality < 4.0 && mode.conductance_S < 10.0 * first.conductance_S;
}

/// A circuit of one mode is judged where it is refused. To magnitudes alone a lead looks like a mode
/// beside the sweep.
bool has_plausible_modes(const Sweep& sweep, const Circuit& circuit) {
  const std::vector<Mode>& all = circuit.modes;
  const auto inside =
      std::count_if(all.begin(), all.end(), [&](const Mode& mode) { return is_in(sweep, mode); });
  const std::ptrdiff_t most_beside = sweep.has_phase ? 2 : 0;
  return static_cast<std::ptrdiff_t>(all.size()) - inside <= most_beside &&
         std::all_of(all.begin(), all.end(), [&](const Mode& mode) {
           return is_apart(sweep, circuit, mode) &&
                  (is_in(sweep, mode) ? is_plausible_inside(sweep, mode)
                                      : is_plausible_beside(sweep, all.front(), mode));
         });
}

}  // namespace

bool is_in(const Sweep& sweep, const Mode& mode) {
  return mode.resonance_Hz >= sweep.frequency_Hz.front() &&
         mode.resonance_Hz <= sweep.frequency_Hz.back();
}

bool is_apart(const Sweep& sweep, const Circuit& circuit, const Mode& mode) {
  constexpr double bands = 2.0;
  const double widest_Hz = 0.25 * (sweep.frequency_Hz.back() - sweep.frequency_Hz.front());
  return std::all_of(circuit.modes.begin(), circuit.modes.end(), [&](const Mode& other) {
    const Mode& larger = mode.conductance_S > other.conductance_S ? mode : other;
    const double band_Hz = larger.bandwidth_Hz < widest_Hz
                               ? larger.bandwidth_Hz
                               : std::min(mode.bandwidth_Hz, other.bandwidth_Hz);
    return &other == &mode || std::abs(mode.resonance_Hz - other.resonance_Hz) > bands * band_Hz;
  });
}

double most_inductance_H(const Circuit& circuit) {
  constexpr double largest_part = 0.05;
  const double omega = two_pi * circuit.modes.front().resonance_Hz;
  return largest_part / (omega * omega * circuit.clamped_capacitance_F);
}

bool is_plausible(const Sweep& sweep, const CircuitFit& fit) {
  return fit.converged && has_plausible_parts(sweep, fit) &&
         (fit.circuit.modes.size() == 1 || has_plausible_modes(sweep, fit.circuit));
}

}  // namespace sonoglide::identify::impedance
