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

/// Phases are off by an angle only where the loss that is left is none that creates energy.
bool has_plausible_rotation(const CircuitFit& fit) {
  if (!fit.parts.has(Part::rotation)) {
    return true;
  }
  constexpr double most_rad = 0.26;
  constexpr double deviations = 3.0;
  const Eigen::Index loss = fit.parts.index(Part::loss_tangent);
  return std::abs(fit.circuit.rotation_rad) <= most_rad &&
         fit.circuit.loss_tangent > -deviations * std::sqrt(fit.covariance(loss, loss));
}

bool is_plausible_inside(const Sweep& sweep, const Mode& mode) {
  const double low_Hz = sweep.frequency_Hz.front();
  const double high_Hz = sweep.frequency_Hz.back();
  constexpr std::ptrdiff_t fewest = 2;
  return mode.resonance_Hz > low_Hz && mode.resonance_Hz < high_Hz &&
         mode.bandwidth_Hz < high_Hz - low_Hz && mode.quality() > 0.5 &&
         std::count_if(sweep.frequency_Hz.begin(), sweep.frequency_Hz.end(), [&](double f) {
           return std::abs(f - mode.resonance_Hz) < mode.bandwidth_Hz;
         }) >= fewest;
}

bool is_plausible_beside(const Sweep& sweep, const Circuit& circuit, const Mode& mode) {
  const double low_Hz = sweep.frequency_Hz.front();
  const double high_Hz = sweep.frequency_Hz.back();
  const double most_Hz = 0.5 * (high_Hz - low_Hz);
  const bool is_above = mode.resonance_Hz > high_Hz && mode.resonance_Hz < high_Hz + most_Hz;
  const bool is_below = mode.resonance_Hz < low_Hz && mode.resonance_Hz > low_Hz - most_Hz;
  constexpr double most_conductance = 10.0;
  return (is_above || is_below) &&
         mode.conductance_S < most_conductance * circuit.modes.front().conductance_S;
}

/// A circuit of one mode is judged where it is refused.
bool has_plausible_modes(const Sweep& sweep, const CircuitFit& fit) {
  const Circuit& circuit = fit.circuit;
  for (std::size_t i = 0; circuit.modes.size() > 1 && i < circuit.modes.size(); ++i) {
    const Mode& mode = circuit.modes[i];
    const bool is_inside = i < static_cast<std::size_t>(fit.parts.modes);
    if (!is_apart(circuit, i) || !(is_inside ? is_plausible_inside(sweep, mode)
                                             : is_plausible_beside(sweep, circuit, mode))) {
      return false;
    }
  }
  return true;
}

}  // namespace

double most_inductance_H(const Circuit& circuit) {
  constexpr double largest_part = 0.05;
  const double omega = two_pi * circuit.modes.front().resonance_Hz;
  return largest_part / (omega * omega * circuit.clamped_capacitance_F);
}

bool is_plausible(const Sweep& sweep, const CircuitFit& fit) {
  constexpr double most_lean = 3.0;
  const Circuit& circuit = fit.circuit;
  const bool is_loss_unsure = !sweep.has_phase && fit.parts.has(Part::loss_tangent);
  return fit.converged && has_plausible_lead(fit) && has_plausible_modes(sweep, fit) &&
         has_plausible_rotation(fit) && std::abs(circuit.lean) <= most_lean &&
         (!is_loss_unsure || (circuit.loss_tangent > 0.0 && is_passive(sweep, circuit)));
}

}  // namespace sonoglide::identify::impedance
