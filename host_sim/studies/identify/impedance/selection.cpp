#include "host_sim/studies/identify/impedance/selection.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace sonoglide::identify::impedance {
namespace {

/// Of the values up to `half` before and behind a place, without that at the place; the upper one of the
/// two in the middle.
double median_around(const Eigen::VectorXd& all, Eigen::Index at, Eigen::Index half) {
  std::vector<double> found;
  for (Eigen::Index i = std::max<Eigen::Index>(at - half, 0);
       i <= std::min(at + half, all.size() - 1); ++i) {
    if (i != at) {
      found.push_back(all(i));
    }
  }
  const auto middle = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2);
  std::nth_element(found.begin(), middle, found.end());
  return *middle;
}

bool is_stray(const Eigen::VectorXd& residuals, const Eigen::VectorXd& steps, Eigen::Index at) {
  constexpr double far = 8.0;
  constexpr double close_by = 4.0;
  constexpr double deviation_of_median = 1.4826 / 1.4142;  // of differences of two
  const double middle = median_around(residuals, at, 3);
  const double deviation =
      deviation_of_median * std::max(median_around(steps, at, 15), median_around(steps, at, 50));
  const auto is_off = [&](Eigen::Index i, double by) {
    return i >= 0 && i < residuals.size() && std::abs(residuals(i) - middle) > by * deviation;
  };
  return is_off(at, far) && !is_off(at - 1, close_by) && !is_off(at + 1, close_by);
}

}  // namespace

std::vector<std::size_t> find_strays(const CircuitFit& fit) {
  const Eigen::Index n = fit.at.log_magnitude.size();
  std::set<std::size_t> strays;
  for (Eigen::Index begin = 0; begin < fit.at.residuals.size(); begin += n) {
    const Eigen::VectorXd residuals = fit.at.residuals.segment(begin, n);
    const Eigen::VectorXd steps = (residuals.tail(n - 1) - residuals.head(n - 1)).cwiseAbs();
    for (Eigen::Index i = 0; i < n; ++i) {
      if (is_stray(residuals, steps, i)) {
        strays.insert(static_cast<std::size_t>(i));
      }
    }
  }
  return {strays.begin(), strays.end()};
}

namespace {

/// Fitted with another noise; where that leads to what is not plausible, the same circuit with it.
CircuitFit with_noise(const Sweep& sweep, const CircuitFit& fit, const Noise& noise) {
  CircuitFit noisy = fit_circuit(sweep, fit.parts, fit.circuit, noise);
  return is_plausible(sweep, noisy) ? noisy : fit_at(sweep, fit.parts, fit.circuit, noise);
}

CircuitFit with_its_noise(const Sweep& sweep, CircuitFit fit, Correlation correlation) {
  constexpr int rounds = 2;
  for (int round = 0; round < rounds; ++round) {
    fit = with_noise(sweep, fit, estimate_noise(fit.at, correlation));
  }
  return fit;
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
  for (const Start& start : start_circuits(sweep, tries)) {
    CircuitFit fit = fit_circuit(sweep, parts, start.circuit, Noise{});
    if (fit.converged && (!best || rank(fit) < rank(*best))) {
      best = std::move(fit);
    }
  }
  if (!best) {
    refuse_without_fit(sweep);
  }
  return with_its_noise(sweep, *best, Correlation::none);
}

/// Schwarz's criterion, and what strong evidence takes beside; a rotation needs none.
double criterion(const CircuitFit& fit) {
  const auto parts =
      static_cast<double>(fit.parts.fitted.count()) - (fit.parts.has(Part::rotation) ? 1.0 : 0.0);
  return schwarz(fit) + strong_evidence * (parts + fit.parts.modes);
}

/// Whether a sweep shows what the larger fit has more.
bool is_seen(const CircuitFit& fit, const CircuitFit& larger) {
  constexpr double half = 0.5;
  const bool fails = fit.description.fails();
  if (fails &&
      std::pow(larger.description.misfit(), 2) <= half * std::pow(fit.description.misfit(), 2)) {
    return true;
  }
  return (!fails || larger.parts.modes > fit.parts.modes) && criterion(larger) < criterion(fit);
}

bool is_preferred(const CircuitFit& other, const CircuitFit& fit) {
  return other.parts.size() > fit.parts.size() ? is_seen(fit, other) : !is_seen(other, fit);
}

using Neighbours = std::vector<CircuitFit>(const Sweep& sweep, const CircuitFit& fit);

/// Goes to the best of the neighbours that are preferred, each with its noise, as long as there is one.
CircuitFit climb(const Sweep& sweep, CircuitFit fit, Neighbours& neighbours,
                 Correlation correlation) {
  while (true) {
    std::optional<CircuitFit> best;
    for (CircuitFit& each : neighbours(sweep, fit)) {
      if (is_preferred(each, fit) && (!best || schwarz(each) < schwarz(*best))) {
        best = std::move(each);
      }
    }
    if (!best) {
      return fit;
    }
    fit = with_its_noise(sweep, *std::move(best), correlation);
  }
}

/// Schwarz's criterion, and strong evidence for a delay beside another part: two parts together often look
/// like a lead alone.
double turning_criterion(const CircuitFit& fit) {
  const bool is_beside = fit.parts.has_lead() || fit.parts.has(Part::rotation);
  return schwarz(fit) + (fit.parts.has(Part::delay) && is_beside ? strong_evidence : 0.0);
}

/// With the likeliest of lead, delay and rotation where one is seen; else, where misfit is none, with a
/// rotation.
CircuitFit with_likeliest_of_phase(const Sweep& sweep, CircuitFit fit) {
  if (!sweep.has_phase) {
    return fit;
  }
  if (!sees_turned_phase(fit)) {
    return fit.description.fails() ? fit : turned_fit(sweep, fit, {Part::rotation}).value_or(fit);
  }
  for (CircuitFit& each : turned_fits(sweep, fit)) {
    if (turning_criterion(each) < turning_criterion(fit)) {
      fit = std::move(each);
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

}  // namespace

Selection select_circuit(const Sweep& measured) {
  Selection selected{{}, measured, {}};
  const Sweep& sweep = selected.sweep;
  CircuitFit& fit = selected.fit;
  fit = first_fit(sweep);
  if (leave_out_strays(fit, selected)) {
    fit = first_fit(sweep);
  }
  fit = climb(sweep, std::move(fit), larger_fits, Correlation::none);
  fit = with_its_noise(sweep, std::move(fit), Correlation::estimated);
  fit = climb(sweep, std::move(fit), smaller_fits, Correlation::estimated);
  fit = with_likeliest_of_phase(sweep, std::move(fit));
  require_resonance(sweep, fit);
  if (fit.description.fails()) {  // misfit is no noise: plain least squares
    fit = with_noise(sweep, fit, sizes(fit.noise));
  }
  require_inside(sweep, fit);
  require_description(sweep, fit);
  allow_for_what_is_not_certain(selected);
  return selected;
}

}  // namespace sonoglide::identify::impedance
