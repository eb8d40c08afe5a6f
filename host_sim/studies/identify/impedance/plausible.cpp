#include "host_sim/studies/identify/impedance/plausible.hpp"

#include <algorithm>
#include <cmath>

#include "host_sim/studies/identify/impedance/start_values.hpp"

namespace sonoglide::identify::impedance {
namespace {

bool has_plausible_lead(const CircuitFit& fit) {
  constexpr double most_share = 0.25;
  const Circuit& circuit = fit.circuit;
  const Lead& lead = circuit.lead;
  return (!fit.parts.has(Part::lead_resistance) || lead.resistance_ohm > 0.0) &&
         (!fit.parts.has(Part::lead_inductance) || lead.inductance_H > 0.0) &&
         lead.resistance_ohm < most_share * circuit.modes.front().resistance_ohm() &&
         lead.inductance_H <= most_inductance_H(circuit);
}

/// Takes no energy out of nothing, at any frequency of the sweep.
bool is_passive(const Sweep& sweep, const Circuit& circuit) {
  return std::all_of(sweep.frequency_Hz.begin(), sweep.frequency_Hz.end(),
                     [&](double f) { return circuit.admittance_S(f).real() > 0.0; });
}

/// Whether a mode is least_distance_bands, of the larger one, off every other; of the narrower one beside
/// one that is too wide for a peak of the sweep and stands for modes that are not fitted yet.
bool is_apart(const Sweep& sweep, const Circuit& circuit, const Mode& one) {
  const double widest_Hz = 0.25 * (sweep.frequency_Hz.back() - sweep.frequency_Hz.front());
  return std::all_of(circuit.modes.begin(), circuit.modes.end(), [&](const Mode& other) {
    const Mode& larger = one.conductance_S > other.conductance_S ? one : other;
    const double band_Hz = larger.bandwidth_Hz < widest_Hz
                               ? larger.bandwidth_Hz
                               : std::min(one.bandwidth_Hz, other.bandwidth_Hz);
    return &one == &other ||
           std::abs(one.resonance_Hz - other.resonance_Hz) > least_distance_bands * band_Hz;
  });
}

bool is_plausible_inside(const Sweep& sweep, const Mode& mode) {
  const double low_Hz = sweep.frequency_Hz.front();
  const double high_Hz = sweep.frequency_Hz.back();
  constexpr std::ptrdiff_t fewest = 2;
  return mode.bandwidth_Hz < 2.0 * (high_Hz - low_Hz) && mode.quality() > 0.5 &&
         std::count_if(sweep.frequency_Hz.begin(), sweep.frequency_Hz.end(), [&](double f) {
           return std::abs(f - mode.resonance_Hz) < mode.bandwidth_Hz;
         }) >= fewest;
}

bool is_plausible_beside(const Sweep& sweep, const Circuit& circuit, const Mode& mode) {
  const double low_Hz = sweep.frequency_Hz.front();
  const double high_Hz = sweep.frequency_Hz.back();
  const Mode& first = circuit.modes.front();
  constexpr double most_conductance = 10.0;
  constexpr double most_quality = 4.0;
  return mode.resonance_Hz > low_Hz - 0.5 * (high_Hz - low_Hz) &&
         mode.resonance_Hz < high_Hz + 0.5 * (high_Hz - low_Hz) &&
         mode.conductance_S < most_conductance * first.conductance_S &&
         std::abs(std::log(mode.quality() / first.quality())) < std::log(most_quality);
}

/// A circuit of one mode is judged where it is refused. To magnitudes alone a lead looks like a mode
/// beside the sweep.
bool has_plausible_modes(const Sweep& sweep, const Circuit& circuit) {
  int beside = 0;
  for (std::size_t i = 0; circuit.modes.size() > 1 && i < circuit.modes.size(); ++i) {
    const Mode& mode = circuit.modes[i];
    const bool is_inside = is_in(sweep, mode);
    beside += is_inside ? 0 : 1;
    if (!is_apart(sweep, circuit, mode) ||
        !(is_inside ? is_plausible_inside(sweep, mode)
                    : is_plausible_beside(sweep, circuit, mode))) {
      return false;
    }
  }
  constexpr int most_beside = 2;
  return beside <= (sweep.has_phase ? most_beside : 0);
}

}  // namespace

bool is_in(const Sweep& sweep, const Mode& mode) {
  return mode.resonance_Hz >= sweep.frequency_Hz.front() &&
         mode.resonance_Hz <= sweep.frequency_Hz.back();
}

double most_inductance_H(const Circuit& circuit) {
  constexpr double largest_part = 0.05;
  const double omega = two_pi * circuit.modes.front().resonance_Hz;
  return largest_part / (omega * omega * circuit.clamped_capacitance_F);
}

bool is_plausible(const Sweep& sweep, const CircuitFit& fit) {
  constexpr double most_lean = 3.0;
  constexpr double most_rad = 0.26;
  const Circuit& circuit = fit.circuit;
  const bool is_loss_unsure = !sweep.has_phase && fit.parts.has(Part::loss_tangent);
  return fit.converged && has_plausible_lead(fit) && has_plausible_modes(sweep, circuit) &&
         std::abs(circuit.rotation_rad) <= most_rad && std::abs(circuit.lean) <= most_lean &&
         (!is_loss_unsure || (circuit.loss_tangent > 0.0 && is_passive(sweep, circuit)));
}

}  // namespace sonoglide::identify::impedance
