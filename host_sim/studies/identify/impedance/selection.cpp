#include "host_sim/studies/identify/impedance/selection.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "host_sim/studies/identify/impedance/description.hpp"
#include "host_sim/studies/identify/impedance/evidence.hpp"
#include "host_sim/studies/identify/impedance/plausible.hpp"
#include "host_sim/studies/identify/impedance/refusal.hpp"
#include "host_sim/studies/identify/impedance/start_values.hpp"
#include "host_sim/studies/identify/impedance/strays.hpp"

namespace sonoglide::identify::impedance {
namespace {

constexpr Part parts_of_phase[] = {Part::rotation, Part::lead_resistance, Part::lead_inductance};

bool is_better(const CircuitFit& fit, const std::optional<CircuitFit>& best) {
  return !best || fit.deviance < best->deviance;
}

/// The converged fit of the least deviance; one whose resonance is sharper than any only where there
/// is no other.
CircuitFit first_fit(const Sweep& sweep, Correlation correlation) {
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
  CircuitFit noisy = fit_circuit_and_noise(sweep, parts, best->circuit, Noise{}, correlation);
  return noisy.converged ? noisy : *best;
}

/// The mode of the largest conductance, of those in the sweep, in the first place.
Circuit largest_first(Circuit circuit, const Parts& parts) {
  const auto largest = std::max_element(
      circuit.modes.begin(), circuit.modes.begin() + parts.modes,
      [](const Mode& a, const Mode& b) { return a.conductance_S < b.conductance_S; });
  std::swap(circuit.modes.front(), *largest);
  return circuit;
}

/// The best plausible fit from these.
std::optional<CircuitFit> best_fit(const Sweep& sweep, const Parts& parts,
                                   const std::vector<Circuit>& starts, const Noise& noise) {
  std::optional<CircuitFit> best;
  for (const Circuit& start : starts) {
    CircuitFit fit = fit_circuit(sweep, parts, largest_first(start, parts), noise);
    if (is_plausible(sweep, fit) && is_better(fit, best)) {
      best = std::move(fit);
    }
  }
  return best;
}

bool has_room_for_mode(const CircuitFit& fit) {
  return fit.parts.modes + fit.parts.beside < most_modes &&
         2 * (fit.p.size() + 3) <= fit.at.residuals.size();
}

constexpr std::size_t tries = 3;

std::optional<CircuitFit> with_another_mode(const Sweep& sweep, const CircuitFit& fit) {
  Parts parts = fit.parts;
  ++parts.modes;
  return has_room_for_mode(fit)
             ? best_fit(sweep, parts, circuits_with_another_mode(sweep, fit, tries), fit.noise)
             : std::nullopt;
}

/// One on either side at most. To magnitudes alone a lead looks like one.
std::optional<CircuitFit> with_mode_beside(const Sweep& sweep, const CircuitFit& fit) {
  constexpr int most = 2;
  Parts parts = fit.parts;
  ++parts.beside;
  return sweep.has_phase && has_room_for_mode(fit) && parts.beside <= most
             ? best_fit(sweep, parts, circuits_with_mode_beside(sweep, fit, tries), fit.noise)
             : std::nullopt;
}

/// A lean has a minimum on either side of none.
std::optional<CircuitFit> with_part(const Sweep& sweep, const CircuitFit& fit, Part part) {
  std::vector<Circuit> starts(part == Part::lean ? 3 : 1, fit.circuit);
  element(starts.front(), part) = part == Part::loss_tangent ? 0.003 : 0.0;
  for (std::size_t i = 1; i < starts.size(); ++i) {
    constexpr double far = 0.7;
    element(starts[i], part) = i == 1 ? far : -far;
  }
  return best_fit(sweep, fit.parts.with(part), starts, fit.noise);
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

/// Whether an F test sees what the larger fit has more. A part that is no mode has also to explain
/// half of the misfit: where none describes the sweep, each takes a little away.
bool is_seen(const Sweep& sweep, const CircuitFit& fit, const CircuitFit& larger) {
  if (larger.parts.modes + larger.parts.beside > fit.parts.modes + fit.parts.beside) {
    const auto places = static_cast<double>(sweep.frequency_Hz.size());
    return chance(fit, larger) * places <= mode_significance;
  }
  constexpr double left = 0.5;
  const double before = describe(fit).misfit();
  const double after = describe(larger).misfit();
  return chance(fit, larger) <= part_significance && after * after <= left * before * before;
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
  add(with_another_mode(sweep, fit));
  add(with_mode_beside(sweep, fit));
  std::sort(fits.begin(), fits.end(), [](const CircuitFit& a, const CircuitFit& b) {
    return a.deviance + penalty(a) < b.deviance + penalty(b);
  });
  return fits;
}

/// Adds, as long as one is seen, the part or mode that takes away most.
CircuitFit with_what_is_seen(const Sweep& sweep, CircuitFit fit, Correlation correlation) {
  while (true) {
    std::vector<CircuitFit> larger = larger_fits(sweep, fit);
    const auto seen = std::find_if(larger.begin(), larger.end(), [&](CircuitFit& each) {
      if (each.deviance < fit.deviance) {
        each = with_its_noise(sweep, each, correlation);
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
    if (fit.parts.has(part) && !(part == Part::loss_tangent && sweep.has_phase)) {
      Circuit start = fit.circuit;
      element(start, part) = 0.0;
      less.emplace_back(fit.parts.with(part, false), start);
    }
  }
  for (std::size_t mode = 1; mode < fit.circuit.modes.size(); ++mode) {
    Circuit start = fit.circuit;
    start.modes.erase(start.modes.begin() + static_cast<std::ptrdiff_t>(mode));
    Parts parts = fit.parts;
    --(mode < static_cast<std::size_t>(parts.modes) ? parts.modes : parts.beside);
    less.emplace_back(parts, start);
  }
  std::vector<CircuitFit> fits;
  for (const auto& [parts, start] : less) {
    CircuitFit smaller = fit_circuit_and_noise(sweep, parts, start, fit.noise);
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
      if (!is_seen(sweep, each, fit) && is_better(each, best)) {
        best = std::move(each);
      }
    }
    if (!best) {
      return fit;
    }
    fit = *std::move(best);
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

/// Up to which value an element of a fit may be.
double most_of(const CircuitFit& fit, Eigen::Index element) {
  constexpr double deviations = 2.0;
  return std::max(fit.p(element), 0.0) + deviations * std::sqrt(fit.covariance(element, element));
}

/// @param fit  without an inductance of the lead
std::optional<UnseenInductance> unseen_inductance(const Sweep& sweep, const CircuitFit& fit) {
  const CircuitFit larger =
      fit_circuit(sweep, fit.parts.with(Part::lead_inductance), fit.circuit, fit.noise);
  if (!larger.converged) {
    return std::nullopt;
  }
  const Eigen::Index lead = larger.parts.index(Part::lead_inductance);
  // How the elements go with the inductance; without it they are off by as much the other way.
  const Eigen::VectorXd off = -larger.covariance.col(lead) / larger.covariance(lead, lead);
  const Eigen::Index first = larger.parts.first_mode();
  return UnseenInductance{std::min(most_of(larger, lead), most_inductance_H(fit.circuit)),
                          off(first + 1), -off(first),
                          off(first) + off(first + 2) - 2.0 * off(first + 1), off(0)};
}

/// The other leads and rotations that may be what is seen of one.
std::vector<CircuitFit> rivals_of_phase(const Sweep& sweep, const CircuitFit& fit) {
  std::vector<CircuitFit> all;
  constexpr unsigned combinations = 8;
  for (unsigned set = 1; set < combinations; ++set) {
    Parts parts = fit.parts;
    Circuit start = fit.circuit;
    for (unsigned i = 0; i < std::size(parts_of_phase); ++i) {
      const bool has = (set >> i & 1U) != 0;
      parts = parts.with(parts_of_phase[i], has);
      element(start, parts_of_phase[i]) *= has ? 1.0 : 0.0;
    }
    if (parts.fitted == fit.parts.fitted) {
      continue;
    }
    CircuitFit rival = fit_circuit(sweep, parts, start, fit.noise);
    if (is_plausible(sweep, rival)) {
      all.push_back(std::move(rival));
    }
  }
  return all;
}

bool sees_lead_or_rotation(const CircuitFit& fit) {
  return std::any_of(std::begin(parts_of_phase), std::end(parts_of_phase),
                     [&](Part each) { return fit.parts.has(each); });
}

/// Where the elements of a fit are in another one; -1 where it does not have them.
std::vector<Eigen::Index> places_in(const CircuitFit& other, const CircuitFit& fit) {
  std::vector<Eigen::Index> places = {0};
  for (std::size_t i = 0; i < part_count; ++i) {
    const auto part = static_cast<Part>(i);
    if (fit.parts.has(part)) {
      places.push_back(other.parts.has(part) ? other.parts.index(part) : -1);
    }
  }
  for (Eigen::Index i = 0; places.size() < static_cast<std::size_t>(fit.p.size()); ++i) {
    places.push_back(
        i < 3 * std::min(fit.parts.modes, other.parts.modes) ? other.parts.first_mode() + i : -1);
  }
  return places;
}

/// Averages the covariance over other circuits, each with its own and the square of the step to it,
/// weighted by its likelihood less a penalty.
/// @param penalties  of each rival over that of the fit, in −2 ln likelihood
/// @return the weights of the rivals
/// Source: Kass and Raftery, Journal of the American Statistical Association 90 (1995).
std::vector<double> allow_for(const std::vector<CircuitFit>& rivals,
                              const std::vector<double>& penalties, CircuitFit& fit) {
  std::vector<double> weights;
  double sum = 1.0;
  for (std::size_t i = 0; i < rivals.size(); ++i) {
    constexpr double most = 50.0;
    const double log_odds = 0.5 * (fit.deviance - rivals[i].deviance - penalties[i]);
    weights.push_back(rivals[i].covariance.allFinite() ? std::exp(std::min(log_odds, most)) : 0.0);
    sum += weights.back();
  }
  const Eigen::MatrixXd own = fit.covariance;
  for (std::size_t k = 0; k < rivals.size(); ++k) {
    weights[k] /= sum;
    const std::vector<Eigen::Index> places = places_in(rivals[k], fit);
    for (Eigen::Index i = 0; i < own.rows(); ++i) {
      for (Eigen::Index j = 0; j < own.cols(); ++j) {
        const Eigen::Index a = places[static_cast<std::size_t>(i)];
        const Eigen::Index b = places[static_cast<std::size_t>(j)];
        if (a >= 0 && b >= 0) {
          const double other = rivals[k].covariance(a, b) +
                               (rivals[k].p(a) - fit.p(i)) * (rivals[k].p(b) - fit.p(j));
          fit.covariance(i, j) += weights[k] * (other - own(i, j));
        }
      }
    }
  }
  return weights;
}

/// The sweep as it is fitted once its noise is known.
Sweep fitted_sweep(const Sweep& sweep, const CircuitFit& fit) {
  return sweep.has_phase && fit.noise.phase_scale > 1.0
             ? with_logarithmic_residuals(sweep, fit.circuit)
             : sweep;
}

void allow_for_what_is_not_certain(const Sweep& sweep, Selection& selected) {
  CircuitFit& fit = selected.fit;
  std::vector<CircuitFit> others;
  std::vector<double> penalties;
  const auto add = [&](const std::optional<CircuitFit>& other, double penalty_of_one) {
    if (other) {
      others.push_back(*other);
      penalties.push_back(penalty_of_one);
    }
  };
  const auto schwarz = [&](const CircuitFit& other) { return penalty(other) - penalty(fit); };
  if (std::optional<CircuitFit> larger = with_another_mode(sweep, fit)) {
    const std::vector<Mode>& modes = larger->circuit.modes;
    const bool is_small = modes[static_cast<std::size_t>(larger->parts.modes) - 1].conductance_S <
                          0.5 * modes.front().conductance_S;
    add(is_small ? larger : std::nullopt, schwarz(*larger));
  }
  if (std::optional<CircuitFit> larger = with_mode_beside(sweep, fit)) {
    add(larger, schwarz(*larger));
  }
  if (!fit.parts.has(Part::lean)) {
    if (const std::optional<CircuitFit> larger = with_part(sweep, fit, Part::lean)) {
      add(larger, schwarz(*larger));
    }
  }
  if (sweep.has_phase && !fit.parts.has(Part::lead_inductance)) {
    selected.unseen_inductance = unseen_inductance(sweep, fit);
  }
  const std::size_t unseen = others.size();
  if (sees_lead_or_rotation(fit)) {
    for (const CircuitFit& each : rivals_of_phase(sweep, fit)) {
      add(each, schwarz(each));
    }
  } else if (sweep.has_phase) {
    CircuitFit larger =
        fit_circuit(sweep, fit.parts.with(Part::lead_resistance), fit.circuit, fit.noise);
    if (larger.converged) {
      selected.unseen_lead_ohm = most_of(larger, larger.parts.index(Part::lead_resistance));
      // Akaike's: leads are always there, and no place is searched for them.
      constexpr double akaike = 2.0;
      add(is_plausible(sweep, larger) ? std::optional(larger) : std::nullopt, akaike);
    }
  }
  fit.covariance = allow_for_correlation(fit.at, fit.noise);
  const std::vector<double> weights = allow_for(others, penalties, fit);
  for (std::size_t i = unseen; i < others.size() && sees_lead_or_rotation(fit); ++i) {
    selected.rivals.push_back({std::move(others[i]), weights[i]});
  }
  allow_for_misfit(fit);
}

}  // namespace

Selection select_circuit(const Sweep& sweep) {
  Selection selected{{}, sweep, {}};
  leave_out_strays(selected);
  CircuitFit& fit = selected.fit;
  fit = first_fit(selected.sweep, Correlation::none);
  fit = with_what_is_seen(selected.sweep, std::move(fit), Correlation::none);
  fit = with_its_noise(selected.sweep, fit, Correlation::estimated);
  fit = without_what_is_not_seen(selected.sweep, std::move(fit));
  require_resonance(selected.sweep, fit, mode_significance);
  const Sweep fitted = fitted_sweep(selected.sweep, fit);
  fit = fit_circuit_and_noise(fitted, fit.parts, fit.circuit, fit.noise);
  fit = with_what_is_seen(fitted, std::move(fit), Correlation::estimated);
  require_inside(fitted, fit);
  require_description(fitted, fit);
  allow_for_what_is_not_certain(fitted, selected);
  return selected;
}

}  // namespace sonoglide::identify::impedance
