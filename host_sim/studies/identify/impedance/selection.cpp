#include "host_sim/studies/identify/impedance/selection.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "host_sim/studies/identify/impedance/description.hpp"
#include "host_sim/studies/identify/impedance/plausible.hpp"
#include "host_sim/studies/identify/impedance/refusal.hpp"
#include "host_sim/studies/identify/impedance/strays.hpp"
#include "host_sim/studies/identify/impedance/uncertainty.hpp"

namespace sonoglide::identify::impedance {
namespace {

bool is_better(const CircuitFit& fit, const std::optional<CircuitFit>& best) {
  return !best || fit.deviance < best->deviance;
}

/// The converged fit of the least deviance; one whose resonance is sharper than any only where there
/// is no other.
CircuitFit first_fit(const Sweep& sweep) {
  constexpr std::size_t tries = 4;
  const Parts parts = Parts{}.with(Part::loss_tangent, sweep.has_phase);
  const auto rank = [](const CircuitFit& fit) {
    return std::pair(fit.circuit.modes.front().quality() > most_quality, fit.deviance);
  };
  std::optional<CircuitFit> best;
  for (const Circuit& start : start_circuits(sweep, tries)) {
    CircuitFit fit = fit_circuit(sweep, parts, start, Noise{});
    if (fit.converged && (!best || rank(fit) < rank(*best))) {
      best = std::move(fit);
    }
  }
  if (!best) {
    refuse_without_fit(sweep);
  }
  CircuitFit noisy = fit_circuit_and_noise(sweep, parts, best->circuit, Noise{}, Correlation::none);
  return noisy.converged ? noisy : *best;
}

/// The mode of the largest conductance, of those in the sweep, in the first place.
Circuit largest_first(const Sweep& sweep, Circuit circuit) {
  const auto largest = std::max_element(
      circuit.modes.begin(), circuit.modes.end(), [&](const Mode& a, const Mode& b) {
        const bool is_a_in = is_in(sweep, a);
        const bool is_b_in = is_in(sweep, b);
        return is_a_in == is_b_in ? a.conductance_S < b.conductance_S : is_b_in;
      });
  std::swap(circuit.modes.front(), *largest);
  return circuit;
}

/// The best plausible fit from these.
std::optional<CircuitFit> best_fit(const Sweep& sweep, const Parts& parts,
                                   const std::vector<Circuit>& starts, const Noise& noise) {
  std::optional<CircuitFit> best;
  for (const Circuit& start : starts) {
    CircuitFit fit = fit_circuit(sweep, parts, largest_first(sweep, start), noise);
    if (is_plausible(sweep, fit) && is_better(fit, best)) {
      best = std::move(fit);
    }
  }
  return best;
}

/// Parts that a sweep may have beside the ones that are fitted.
std::vector<Part> further_parts(const Sweep& sweep, const Parts& parts) {
  std::vector<Part> all = {Part::lean};
  if (sweep.has_phase) {
    all.insert(all.end(), std::begin(parts_of_phase), std::end(parts_of_phase));
  } else {
    all.push_back(Part::loss_tangent);
  }
  all.erase(std::remove_if(all.begin(), all.end(), [&](Part each) { return parts.has(each); }),
            all.end());
  return all;
}

/// Whether the smaller fit does not describe the sweep, and the larger one takes half of the misfit.
bool spoils(const CircuitFit& fit, const CircuitFit& larger) {
  constexpr double left = 0.5;
  const Description before = describe(fit);
  return before.fails() && std::pow(describe(larger).misfit() / before.misfit(), 2) <= left;
}

/// Whether an F test sees what the larger fit has more. Where the smaller one does not describe the
/// sweep, a part that is no mode has also to explain half of the misfit: where none does, each takes a
/// little away.
bool is_seen(const Sweep& sweep, const CircuitFit& fit, const CircuitFit& larger) {
  if (larger.parts.modes > fit.parts.modes) {
    const auto places = static_cast<double>(sweep.frequency_Hz.size());
    return chance(fit, larger) * places <= mode_significance;
  }
  return chance(fit, larger) <= part_significance &&
         (!describe(fit).fails() || spoils(fit, larger));
}

CircuitFit with_its_noise(const Sweep& sweep, const CircuitFit& fit, Correlation correlation) {
  CircuitFit noisy = fit_circuit_and_noise(sweep, fit.parts, fit.circuit, fit.noise, correlation);
  return is_plausible(sweep, noisy) ? noisy : fit;
}

/// All fits with one part or mode more, the best first.
std::vector<CircuitFit> larger_fits(const Sweep& sweep, const CircuitFit& fit) {
  std::vector<CircuitFit> fits;
  const auto add = [&](std::optional<CircuitFit> larger) {
    if (larger) {
      fits.push_back(*std::move(larger));
    }
  };
  for (const Part each : further_parts(sweep, fit.parts)) {
    add(with_part(sweep, fit, each));
  }
  add(with_another_mode(sweep, fit, Place::inside));
  add(with_another_mode(sweep, fit, Place::beside));
  std::sort(fits.begin(), fits.end(),
            [](const CircuitFit& a, const CircuitFit& b) { return schwarz(a) < schwarz(b); });
  return fits;
}

/// Adds, as long as one is seen, the part or mode that takes away most.
CircuitFit with_what_is_seen(const Sweep& sweep, CircuitFit fit) {
  while (true) {
    std::vector<CircuitFit> larger = larger_fits(sweep, fit);
    const auto seen = std::find_if(larger.begin(), larger.end(), [&](CircuitFit& each) {
      if (each.deviance < fit.deviance) {
        each = with_its_noise(sweep, each, Correlation::none);
      }
      return is_seen(sweep, fit, each);
    });
    if (seen == larger.end()) {
      return fit;
    }
    fit = std::move(*seen);
  }
}

/// All fits with one part or mode less.
std::vector<CircuitFit> smaller_fits(const Sweep& sweep, const CircuitFit& fit) {
  std::vector<std::pair<Parts, Circuit>> less;
  for (std::size_t i = 0; i < part_count; ++i) {
    const auto part = static_cast<Part>(i);
    if (fit.parts.has(part) && !(sweep.has_phase && part == Part::loss_tangent)) {
      Circuit start = fit.circuit;
      element(start, part) = 0.0;
      less.emplace_back(fit.parts.with(part, false), start);
    }
  }
  for (std::size_t mode = 1; mode < fit.circuit.modes.size(); ++mode) {
    Circuit start = fit.circuit;
    start.modes.erase(start.modes.begin() + static_cast<std::ptrdiff_t>(mode));
    Parts parts = fit.parts;
    --parts.modes;
    less.emplace_back(parts, start);
  }
  std::vector<CircuitFit> fits;
  for (const auto& [parts, start] : less) {
    CircuitFit smaller = fit_circuit(sweep, parts, start, fit.noise);
    if (is_plausible(sweep, smaller)) {
      fits.push_back(std::move(smaller));
    }
  }
  return fits;
}

/// Takes out, as long as there is one, the part or mode that is seen least.
CircuitFit without_what_is_not_seen(const Sweep& sweep, CircuitFit fit) {
  while (true) {
    std::optional<CircuitFit> best;
    for (CircuitFit& each : smaller_fits(sweep, fit)) {
      if (!is_seen(sweep, each, fit) && !spoils(each, fit) && is_better(each, best)) {
        best = std::move(each);
      }
    }
    if (!best) {
      return fit;
    }
    fit = with_its_noise(sweep, *best, Correlation::estimated);
  }
}

/// With a rotation where no lead is seen and misfit is none, or with the lead or rotation that
/// Schwarz's criterion takes in place of the one that is seen.
CircuitFit with_likeliest_of_phase(const Sweep& sweep, CircuitFit fit) {
  if (!sweep.has_phase) {
    return fit;
  }
  if (!sees_lead_or_rotation(fit)) {
    if (describe(fit).fails()) {
      return fit;
    }
    CircuitFit rotated = fit_circuit(sweep, fit.parts.with(Part::rotation), fit.circuit, fit.noise);
    if (!is_plausible(sweep, rotated)) {
      return fit;
    }
    fit = std::move(rotated);
  }
  if (sees_lead_or_rotation(fit)) {
    for (CircuitFit& each : rivals_of_phase(sweep, fit)) {
      if (schwarz(each) < schwarz(fit)) {
        fit = std::move(each);
      }
    }
  }
  return fit;
}

/// Takes out strays, where they are few. @return whether there are any
bool leave_out_strays(const CircuitFit& fit, Selection& selected) {
  Sweep& sweep = selected.sweep;
  const std::vector<std::size_t> strays = find_strays(fit);
  constexpr std::size_t least_share = 20;
  if (strays.empty() || strays.size() * least_share >= sweep.frequency_Hz.size()) {
    return false;
  }
  for (auto each = strays.rbegin(); each != strays.rend(); ++each) {
    const auto at = static_cast<std::ptrdiff_t>(*each);
    selected.left_out_Hz.insert(selected.left_out_Hz.begin(), sweep.frequency_Hz[*each]);
    sweep.frequency_Hz.erase(sweep.frequency_Hz.begin() + at);
    sweep.admittance_S.erase(sweep.admittance_S.begin() + at);
  }
  return true;
}

/// The sweep as it is fitted once its noise is known.
Sweep fitted_sweep(const Sweep& sweep, const CircuitFit& fit) {
  return sweep.has_phase && fit.noise.phase_scale > 1.0
             ? with_logarithmic_residuals(sweep, fit.circuit)
             : sweep;
}

}  // namespace

std::optional<CircuitFit> with_another_mode(const Sweep& sweep, const CircuitFit& fit,
                                            Place place) {
  if (fit.parts.modes == most_modes || 2 * (fit.p.size() + 3) > fit.at.residuals.size() ||
      (place == Place::beside && !sweep.has_phase)) {
    return std::nullopt;
  }
  constexpr std::size_t tries = 3;
  Parts parts = fit.parts;
  ++parts.modes;
  return best_fit(sweep, parts, circuits_with_another_mode(sweep, fit, place, tries), fit.noise);
}

std::optional<CircuitFit> with_part(const Sweep& sweep, const CircuitFit& fit, Part part) {
  const Parts parts = fit.parts.with(part);
  const Solution solution = solve(linearise(sweep, parts, fit.circuit), fit.noise);
  const Eigen::Index at = parts.index(part);
  if (solution.step(at) * solution.step(at) < gain_to_fit(fit) * solution.covariance(at, at)) {
    return std::nullopt;
  }
  std::vector<Circuit> starts(1, fit.circuit);
  element(starts.front(), part) = part == Part::loss_tangent ? 0.003 : 0.0;
  if (part == Part::lean) {  // There are minima on either side of none.
    for (const double far : {0.7, -0.7}) {
      starts.push_back(fit.circuit);
      starts.back().lean = far;
    }
  }
  return best_fit(sweep, parts, starts, fit.noise);
}

Selection select_circuit(const Sweep& sweep) {
  Selection selected{{}, sweep, {}};
  CircuitFit& fit = selected.fit;
  fit = first_fit(selected.sweep);
  if (leave_out_strays(fit, selected)) {
    fit = first_fit(selected.sweep);
  }
  fit = with_what_is_seen(selected.sweep, std::move(fit));
  fit = with_its_noise(selected.sweep, fit, Correlation::estimated);
  fit = without_what_is_not_seen(selected.sweep, std::move(fit));
  fit = with_likeliest_of_phase(selected.sweep, std::move(fit));
  if (describe(fit).fails()) {  // misfit is no noise: plain least squares
    fit = fit_circuit(selected.sweep, fit.parts, fit.circuit, sizes(fit.noise));
  }
  require_resonance(selected.sweep, fit, mode_significance);
  const Sweep fitted = fitted_sweep(selected.sweep, fit);
  fit = fit_circuit(fitted, fit.parts, fit.circuit, fit.noise);
  require_inside(fitted, fit);
  require_description(fitted, fit);
  allow_for_what_is_not_certain(fitted, selected);
  return selected;
}

}  // namespace sonoglide::identify::impedance
