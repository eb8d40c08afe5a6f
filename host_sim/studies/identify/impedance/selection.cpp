#include "host_sim/studies/identify/impedance/selection.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "host_sim/studies/identify/impedance/description.hpp"
#include "host_sim/studies/identify/impedance/evidence.hpp"
#include "host_sim/studies/identify/impedance/refusal.hpp"
#include "host_sim/studies/identify/impedance/start_values.hpp"
#include "host_sim/studies/identify/impedance/strays.hpp"

namespace sonoglide::identify::impedance {
namespace {

/// The converged fit of the least deviance; one whose resonance is sharper than any only where there
/// is no other.
std::optional<CircuitFit> best_fit(const Sweep& sweep, Parts parts,
                                   const std::vector<Circuit>& starts, const Noise& noise) {
  const auto rank = [](const CircuitFit& fit) {
    return std::pair(fit.circuit.modes.front().quality() > most_quality, fit.deviance);
  };
  std::optional<CircuitFit> best;
  for (const Circuit& start : starts) {
    CircuitFit fit = fit_circuit(sweep, parts, start, noise);
    if (fit.converged && (!best || rank(fit) < rank(*best))) {
      best = std::move(fit);
    }
  }
  return best;
}

/// Readings less than a band width off the resonance of a mode.
std::size_t readings_near(const Sweep& sweep, const Mode& mode) {
  return static_cast<std::size_t>(
      std::count_if(sweep.frequency_Hz.begin(), sweep.frequency_Hz.end(),
                    [&](double f) { return std::abs(f - mode.resonance_Hz) < mode.bandwidth_Hz; }));
}

/// A mode outside the sweep, or wider than it, is a slope that a mode can imitate; one between two
/// readings is seen by none.
bool is_plausible(const Sweep& sweep, const Mode& added) {
  constexpr std::size_t fewest = 2;
  const double low_Hz = sweep.frequency_Hz.front();
  const double high_Hz = sweep.frequency_Hz.back();
  return added.resonance_Hz > low_Hz && added.resonance_Hz < high_Hz &&
         added.bandwidth_Hz < high_Hz - low_Hz && added.quality() > 0.5 &&
         readings_near(sweep, added) >= fewest;
}

/// Passive, and its resistance small beside the motional one: an error of the phase looks like a large
/// one.
bool has_plausible_lead(const CircuitFit& fit) {
  constexpr double most_share = 0.25;
  const Lead& lead = fit.circuit.lead;
  const LeadModel model = fit.parts.lead;
  return (!has_resistance(model) || lead.resistance_ohm > 0.0) &&
         (!has_inductance(model) || lead.inductance_H > 0.0) &&
         std::all_of(fit.circuit.modes.begin(), fit.circuit.modes.end(), [&](const Mode& mode) {
           return lead.resistance_ohm < most_share * mode.resistance_ohm();
         });
}

/// Whether least squares found a minimum with a plausible lead and, of several modes, plausible ones.
bool is_sound(const Sweep& sweep, const CircuitFit& fit) {
  const std::vector<Mode>& modes = fit.circuit.modes;
  return fit.converged && has_plausible_lead(fit) &&
         (modes.size() == 1 || std::all_of(modes.begin(), modes.end(), [&](const Mode& mode) {
            return is_plausible(sweep, mode);
          }));
}

/// The fit with the mode that its residuals ask for most, where there is a plausible one.
std::optional<CircuitFit> with_another_mode(const Sweep& sweep, const CircuitFit& fit,
                                            Correlation correlation, int most = most_modes) {
  constexpr std::size_t tries = 3;
  Parts parts = fit.parts;
  ++parts.modes;
  if (parts.modes > most || 2 * parameters(parts) > fit.at.residuals.size()) {
    return std::nullopt;
  }
  std::optional<CircuitFit> best;
  for (const Circuit& start : circuits_with_another_mode(sweep, fit, tries)) {
    CircuitFit larger = fit_circuit(sweep, parts, start, fit.noise);
    if (larger.converged && is_plausible(sweep, larger.circuit.modes.back()) &&
        (!best || larger.deviance < best->deviance)) {
      best = std::move(larger);
    }
  }
  if (best) {
    *best = fit_circuit_and_noise(sweep, parts, best->circuit, best->noise, correlation);
  }
  return best && best->converged && is_plausible(sweep, best->circuit.modes.back()) ? best
                                                                                    : std::nullopt;
}

/// Whether an F test sees the modes that the larger fit has more, each looked for at every reading.
bool is_seen(const Sweep& sweep, const CircuitFit& fit, const CircuitFit& larger) {
  const auto places = static_cast<double>(sweep.frequency_Hz.size());
  return chance(fit, larger) * std::pow(places, larger.parts.modes - fit.parts.modes) <=
         mode_significance;
}

/// Whether the last mode is a smaller one beside the others: two that overlap are one to any sweep.
bool stands_apart(const CircuitFit& fit) {
  const std::vector<Mode>& modes = fit.circuit.modes;
  const Mode& last = modes.back();
  return std::all_of(modes.begin(), modes.end() - 1, [&](const Mode& other) {
    return last.conductance_S < 0.5 * other.conductance_S &&
           std::abs(last.resonance_Hz - other.resonance_Hz) >
               std::max(last.bandwidth_Hz, other.bandwidth_Hz);
  });
}

/// What a part that is not certain adds to the covariance: the larger fit counts by its likelihood
/// against the smaller one's, less a cost, with its own covariance and the square of the step to it.
/// @param kept  where in the larger fit the parameters of the smaller one are
/// @param cost  in the logarithm of the likelihood
/// Source: Kass and Raftery, Journal of the American Statistical Association 90 (1995).
void allow_for(const CircuitFit& larger, const std::vector<Eigen::Index>& kept, double cost,
               CircuitFit& fit) {
  const double log_odds = 0.5 * (fit.deviance - larger.deviance) - cost;
  const double weight = 1.0 / (1.0 + std::exp(-log_odds));
  const Eigen::VectorXd step = larger.p(kept) - fit.p;
  const Eigen::MatrixXd other = larger.covariance(kept, kept) + step * step.transpose();
  if (other.allFinite()) {
    fit.covariance = (1.0 - weight) * fit.covariance + weight * other;
  }
}

std::vector<Eigen::Index> counted(Eigen::Index from, Eigen::Index to) {
  std::vector<Eigen::Index> all(static_cast<std::size_t>(to - from));
  std::iota(all.begin(), all.end(), from);
  return all;
}

/// Changes places with the first mode.
void put_largest_first(CircuitFit& fit) {
  std::vector<Mode>& modes = fit.circuit.modes;
  const auto largest = std::max_element(
      modes.begin(), modes.end(),
      [](const Mode& a, const Mode& b) { return a.conductance_S < b.conductance_S; });
  const Eigen::Index first = first_mode(fit.parts);
  const Eigen::Index other = first + 3 * (largest - modes.begin());
  if (other == first) {
    return;
  }
  Eigen::PermutationMatrix<Eigen::Dynamic> swap(fit.p.size());
  swap.setIdentity();
  for (Eigen::Index i = 0; i < 3; ++i) {
    std::swap(swap.indices()(first + i), swap.indices()(other + i));
  }
  std::swap(modes.front(), *largest);
  fit.p = swap * fit.p;
  fit.at.jacobian = fit.at.jacobian * swap.transpose();
  fit.covariance = swap * fit.covariance * swap.transpose();
}

CircuitFit first_fit(const Sweep& sweep, Correlation correlation) {
  constexpr std::size_t tries = 4;
  std::optional<CircuitFit> fit =
      best_fit(sweep, {sweep.has_phase, 1}, start_circuits(sweep, tries), Noise{});
  if (!fit) {
    refuse_without_fit(sweep);
  }
  CircuitFit noisy = fit_circuit_and_noise(sweep, fit->parts, fit->circuit, Noise{}, correlation);
  return noisy.converged ? noisy : *fit;
}

/// Fits of one mode more each, as far as an F test sees them that takes all misfit for modes.
std::vector<CircuitFit> fits_of_rising_modes(const Sweep& sweep) {
  std::vector<CircuitFit> fits = {first_fit(sweep, Correlation::none)};
  while (true) {
    std::optional<CircuitFit> larger = with_another_mode(sweep, fits.back(), Correlation::none);
    if (!larger || !is_seen(sweep, fits.back(), *larger)) {
      return fits;
    }
    fits.push_back(*std::move(larger));
  }
}

/// The fits with as many modes as the residuals ask for, the last, and with fewer, before it.
///
/// A mode that is not fitted looks like noise that hangs together, and several of them hide each
/// other: so all that may be modes are fitted first, and then each number of them, with the noise
/// that is likeliest for it, is tested against the smaller numbers.
std::vector<CircuitFit> fits_up_to_number_of_modes(const Sweep& sweep) {
  std::vector<CircuitFit> fits = fits_of_rising_modes(sweep);
  fits.front() = first_fit(sweep, Correlation::estimated);
  std::size_t chosen = 0;
  for (std::size_t i = 1; i < fits.size(); ++i) {
    CircuitFit noisy =
        fit_circuit(sweep, fits[i].parts, fits[i].circuit, estimate_noise(fits[i].at));
    if (noisy.converged) {
      fits[i] = std::move(noisy);
    }
    if (is_sound(sweep, fits[i]) && is_seen(sweep, fits[chosen], fits[i])) {
      chosen = i;
    }
  }
  fits.resize(chosen + 1, fits.front());
  return fits;
}

CircuitFit with_lead(const Sweep& sweep, const CircuitFit& fit, LeadModel model) {
  Parts parts = fit.parts;
  parts.lead = model;
  return fit_circuit_and_noise(sweep, parts, fit.circuit, fit.noise);
}

/// The fit with the lead that an F test sees: resistance or inductance, the likelier, or both where
/// they are seen beside it.
std::optional<CircuitFit> with_lead_that_is_seen(const Sweep& sweep, const CircuitFit& fit) {
  std::optional<CircuitFit> best;
  for (const LeadModel model : {LeadModel::resistance, LeadModel::inductance}) {
    CircuitFit larger = with_lead(sweep, fit, model);
    if (is_sound(sweep, larger) && chance(fit, larger) < lead_significance &&
        (!best || larger.deviance < best->deviance)) {
      best = std::move(larger);
    }
  }
  CircuitFit both = with_lead(sweep, fit, LeadModel::resistance_and_inductance);
  if (is_sound(sweep, both) && chance(best ? *best : fit, both) < lead_significance) {
    best = std::move(both);
  }
  return best;
}

/// The last of the fits or, where a lead is seen, the fit with it. Modes can imitate a lead: one that
/// describes the sweep as well with fewer modes takes their place.
CircuitFit with_lead_if_seen(const Sweep& sweep, const std::vector<CircuitFit>& fits) {
  const CircuitFit& last = fits.back();
  for (const CircuitFit& each : fits) {
    Parts parts = each.parts;
    parts.lead = LeadModel::resistance_and_inductance;
    const bool may_do =
        each.parts.modes == last.parts.modes ||
        fit_circuit(sweep, parts, each.circuit, last.noise).deviance <= last.deviance;
    if (may_do) {
      std::optional<CircuitFit> larger = with_lead_that_is_seen(sweep, each);
      if (larger && larger->deviance <= last.deviance) {
        return *std::move(larger);
      }
    }
  }
  return last;
}

/// Up to which value an element of a fit may be.
double most_of(const CircuitFit& fit, Eigen::Index element) {
  constexpr double deviations = 2.0;
  return std::max(fit.p(element), 0.0) + deviations * std::sqrt(fit.covariance(element, element));
}

/// @param fit  without an inductance of the lead
std::optional<UnseenInductance> unseen_inductance(const Sweep& sweep, const CircuitFit& fit) {
  const CircuitFit larger =
      with_lead(sweep, fit,
                has_resistance(fit.parts.lead) ? LeadModel::resistance_and_inductance
                                               : LeadModel::inductance);
  if (!larger.converged) {
    return std::nullopt;
  }
  const Eigen::Index lead = inductance_of_lead(larger.parts);
  // How the elements go with the inductance; without it they are off by as much the other way.
  const Eigen::VectorXd off = -larger.covariance.col(lead) / larger.covariance(lead, lead);
  const Eigen::Index first = first_mode(larger.parts);
  return UnseenInductance{microhenry_H * most_of(larger, lead), off(first + 1), -off(first),
                          off(first) + off(first + 2) - 2.0 * off(first + 1), off(0)};
}

/// What a resistance of the lead that is not seen adds to the covariance.
/// @return the resistance up to which the sweep may have one, where a fit with one converges
std::optional<double> allow_for_lead(const Sweep& sweep, CircuitFit& fit) {
  const CircuitFit larger =
      with_lead(sweep, fit,
                has_inductance(fit.parts.lead) ? LeadModel::resistance_and_inductance
                                               : LeadModel::resistance);
  if (!larger.converged) {
    return std::nullopt;
  }
  const Eigen::Index lead = first_of_lead(larger.parts);
  if (is_sound(sweep, larger)) {
    std::vector<Eigen::Index> kept = counted(0, lead);
    const std::vector<Eigen::Index> behind = counted(lead + 1, larger.p.size());
    kept.insert(kept.end(), behind.begin(), behind.end());
    // Akaike's: leads are always there, and no place is searched for them.
    constexpr double akaike = 1.0;
    allow_for(larger, kept, akaike, fit);
  }
  return most_of(larger, lead);
}

/// Takes no energy out of nothing, at any frequency of the sweep.
bool is_passive(const Sweep& sweep, const Circuit& circuit) {
  return std::all_of(sweep.frequency_Hz.begin(), sweep.frequency_Hz.end(),
                     [&](double f) { return circuit.admittance_S(f).real() > 0.0; });
}

/// Of magnitudes alone: the loss tangent where an F test sees it. Magnitudes are blind to a sign of
/// the conductance at antiresonance, so only a passive circuit counts.
void add_loss(const Sweep& sweep, CircuitFit& fit) {
  Circuit start = fit.circuit;
  start.loss_tangent = 0.003;
  CircuitFit larger = fit_circuit_and_noise(sweep, {true, fit.parts.modes}, start, fit.noise);
  if (larger.converged && larger.circuit.loss_tangent > 0.0 && is_passive(sweep, larger.circuit) &&
      chance(fit, larger) < loss_significance) {
    fit = std::move(larger);
  }
}

/// Adds the weak modes that an F test sees beside the noise as it is now.
/// @return the fit with one mode more, which is not seen
std::optional<CircuitFit> add_modes(const Sweep& sweep, CircuitFit& fit) {
  while (true) {
    std::optional<CircuitFit> larger = with_another_mode(sweep, fit, Correlation::estimated);
    if (!larger || !is_sound(sweep, *larger)) {
      return std::nullopt;
    }
    if (!is_seen(sweep, fit, *larger)) {
      return larger;
    }
    fit = *std::move(larger);
  }
}

/// Takes out strays, where they are few.
void leave_out_strays(Selection& selected) {
  Sweep& sweep = selected.sweep;
  const std::vector<std::size_t> strays = find_strays(first_fit(sweep, Correlation::estimated));
  constexpr std::size_t least_share = 20;
  if (strays.size() * least_share >= sweep.frequency_Hz.size()) {
    return;
  }
  for (auto each = strays.rbegin(); each != strays.rend(); ++each) {
    const auto at = static_cast<std::ptrdiff_t>(*each);
    selected.left_out_Hz.insert(selected.left_out_Hz.begin(), sweep.frequency_Hz[*each]);
    sweep.frequency_Hz.erase(sweep.frequency_Hz.begin() + at);
    sweep.admittance_S.erase(sweep.admittance_S.begin() + at);
  }
}

/// The sweep as it is fitted once its noise is known.
Sweep fitted_sweep(const Sweep& sweep, const CircuitFit& fit) {
  return sweep.has_phase && fit.noise.phase_scale > 1.0
             ? with_logarithmic_residuals(sweep, fit.circuit)
             : sweep;
}

/// The figures of the most modes may be off by as much as another one that is seen shifts them.
void allow_for_mode_too_many(const Sweep& sweep, Selection& selected) {
  CircuitFit& fit = selected.fit;
  if (fit.parts.modes < most_modes) {
    return;
  }
  const std::optional<CircuitFit> larger =
      with_another_mode(sweep, fit, Correlation::estimated, most_modes + 1);
  if (larger && is_seen(sweep, fit, *larger)) {
    selected.mode_too_many_Hz = larger->circuit.modes.back().resonance_Hz;
    allow_for(*larger, counted(0, fit.p.size()), 0.0, fit);
  }
}

/// @param larger  with one mode more, which is not seen
void allow_for_what_is_not_certain(const Sweep& sweep, const std::optional<CircuitFit>& larger,
                                   Selection& selected) {
  CircuitFit& fit = selected.fit;
  fit.covariance = allow_for_correlation(fit.at, fit.noise).covariance;
  if (larger && larger->parts.loss_tangent == fit.parts.loss_tangent && stands_apart(*larger)) {
    const double schwarz = 0.5 * static_cast<double>(larger->p.size() - fit.p.size()) *
                           std::log(static_cast<double>(fit.at.residuals.size()));
    allow_for(*larger, counted(0, fit.p.size()), schwarz, fit);
  }
  allow_for_mode_too_many(sweep, selected);
  if (sweep.has_phase && !has_inductance(fit.parts.lead)) {
    selected.unseen_inductance = unseen_inductance(sweep, fit);
  }
  if (sweep.has_phase && !has_resistance(fit.parts.lead)) {
    selected.unseen_lead_ohm = allow_for_lead(sweep, fit);
  }
  allow_for_misfit(fit);
}

}  // namespace

Selection select_circuit(const Sweep& sweep) {
  Selection selected{{}, sweep, {}};
  leave_out_strays(selected);
  const std::vector<CircuitFit> fits = fits_up_to_number_of_modes(selected.sweep);
  require_resonance(selected.sweep, fits.back(), mode_significance);
  CircuitFit& fit = selected.fit;
  fit = sweep.has_phase ? with_lead_if_seen(selected.sweep, fits) : fits.back();
  const Sweep fitted = fitted_sweep(selected.sweep, fit);
  fit = fit_circuit_and_noise(fitted, fit.parts, fit.circuit, fit.noise);
  const std::optional<CircuitFit> larger = add_modes(fitted, fit);
  if (!sweep.has_phase) {
    add_loss(fitted, fit);
  }
  require_inside(fitted, fit);
  require_description(fitted, fit);
  allow_for_what_is_not_certain(fitted, larger, selected);
  put_largest_first(fit);
  return selected;
}

}  // namespace sonoglide::identify::impedance
