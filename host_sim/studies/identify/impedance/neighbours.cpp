#include "host_sim/studies/identify/impedance/selection.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace sonoglide::identify::impedance {
namespace {

constexpr Part parts_of_phase[] = {Part::rotation, Part::delay, Part::lead_resistance,
                                   Part::lead_inductance};

bool is_of_phase(Part part) {
  return std::find(std::begin(parts_of_phase), std::end(parts_of_phase), part) !=
         std::end(parts_of_phase);
}

/// The mode of the largest conductance, of those in the sweep, in the first place.
Circuit largest_first(const Sweep& sweep, Circuit circuit) {
  const auto rank = [&](const Mode& mode) {
    return std::pair(is_in(sweep, mode), mode.conductance_S);
  };
  std::swap(circuit.modes.front(),
            *std::max_element(circuit.modes.begin(), circuit.modes.end(),
                              [&](const Mode& a, const Mode& b) { return rank(a) < rank(b); }));
  return circuit;
}

/// The best plausible fit from these.
std::optional<CircuitFit> best_fit(const Sweep& sweep, const Parts& parts, const Noise& noise,
                                   const std::vector<Circuit>& starts) {
  std::optional<CircuitFit> best;
  for (const Circuit& start : starts) {
    CircuitFit fit = fit_circuit(sweep, parts, largest_first(sweep, start), noise);
    if (is_plausible(sweep, fit) && (!best || fit.deviance < best->deviance)) {
      best = std::move(fit);
    }
  }
  return best;
}

void add_best(const Sweep& sweep, const Parts& parts, const Noise& noise,
              const std::vector<Circuit>& starts, std::vector<CircuitFit>& fits) {
  if (std::optional<CircuitFit> best = best_fit(sweep, parts, noise, starts)) {
    fits.push_back(*std::move(best));
  }
}

Circuit with_value(Circuit circuit, Part part, double value) {
  element(circuit, part) = value;
  return circuit;
}

void add_with_part(const Sweep& sweep, const CircuitFit& fit, Part part, double least,
                   std::vector<CircuitFit>& fits) {
  const Parts parts = fit.parts.with(part);
  const Solution solution = solve(linearise(sweep, parts, fit.circuit), fit.noise);
  const std::vector<Eigen::Index> fitted = parts.indices();
  const auto at = std::find(fitted.begin(), fitted.end(), index_of(part)) - fitted.begin();
  if (part != Part::lean &&
      solution.step(at) * solution.step(at) < least * solution.covariance(at, at)) {
    return;
  }
  std::vector<Circuit> starts = {
      with_value(fit.circuit, part, part == Part::loss_tangent ? 0.003 : 0.0)};
  if (part == Part::lean) {
    starts.push_back(with_value(fit.circuit, part, 0.7));
    starts.push_back(with_value(fit.circuit, part, -0.7));
  }
  if (part == Part::rotation && fit.description.fails() && fit.parts.modes == 1) {
    // What turns the phases may have led the fit far off.
    constexpr std::size_t tries = 4;
    for (Start& each : start_circuits(sweep, tries)) {
      starts.push_back(std::move(each.circuit));
    }
  }
  add_best(sweep, parts, fit.noise, starts, fits);
}

}  // namespace

std::vector<CircuitFit> larger_fits(const Sweep& sweep, const CircuitFit& fit) {
  constexpr double least_gain = 4.0;
  const double least = fit.description.fails() ? 0.0 : least_gain;
  std::vector<CircuitFit> fits;
  for (std::size_t i = 0; i < part_count; ++i) {
    const auto part = static_cast<Part>(i);
    if (!fit.parts.has(part) && (sweep.has_phase || !is_of_phase(part))) {
      add_with_part(sweep, fit, part, least, fits);
    }
  }
  if (fit.parts.modes < most_modes && 2 * (fit.parts.size() + 3) <= fit.at.residuals.size()) {
    constexpr std::size_t tries = 4;
    std::vector<Circuit> starts;
    for (Start& each : starts_with_another_mode(sweep, fit, least, tries)) {
      starts.push_back(std::move(each.circuit));
    }
    Parts parts = fit.parts;
    ++parts.modes;
    add_best(sweep, parts, fit.noise, starts, fits);
  }
  return fits;
}

std::vector<CircuitFit> smaller_fits(const Sweep& sweep, const CircuitFit& fit) {
  std::vector<CircuitFit> fits;
  for (std::size_t i = 0; i < part_count; ++i) {
    const auto part = static_cast<Part>(i);
    const bool stays =
        sweep.has_phase &&
        (part == Part::loss_tangent ||
         (part == Part::rotation && !fit.parts.has_lead_or_delay() && !fit.description.fails()));
    if (fit.parts.has(part) && !stays) {
      add_best(sweep, fit.parts.with(part, false), fit.noise, {with_value(fit.circuit, part, 0.0)},
               fits);
    }
  }
  Parts parts = fit.parts;
  --parts.modes;
  for (std::size_t mode = 1; mode < fit.circuit.modes.size(); ++mode) {
    Circuit start = fit.circuit;
    start.modes.erase(start.modes.begin() + static_cast<std::ptrdiff_t>(mode));
    add_best(sweep, parts, fit.noise, {start}, fits);
  }
  return fits;
}

namespace {

/// Whether the sweep determines a delay, if it is fitted, beside the other parts: to 7.5 degrees at the
/// resonance, standard deviation, half of what a delay may be. A narrow sweep does not beside a rotation.
bool determines_delay(const CircuitFit& fit) {
  constexpr double most_rad = 0.13;
  const Eigen::Index at = index_of(Part::delay);
  return two_pi * fit.circuit.modes.front().resonance_Hz * std::sqrt(fit.covariance(at, at)) <
         most_rad;
}

}  // namespace

std::optional<CircuitFit> turned_fit(const Sweep& sweep, const CircuitFit& fit,
                                     const std::vector<Part>& turning) {
  Parts parts = fit.parts;
  Circuit start = fit.circuit;
  for (const Part each : parts_of_phase) {
    const bool has = std::find(turning.begin(), turning.end(), each) != turning.end();
    parts = parts.with(each, has);
    element(start, each) *= has ? 1.0 : 0.0;
  }
  if (parts.fitted == fit.parts.fitted) {
    return std::nullopt;
  }
  std::optional<CircuitFit> turned = best_fit(sweep, parts, fit.noise, {start});
  return turned && determines_delay(*turned) ? turned : std::nullopt;
}

std::vector<CircuitFit> turned_fits(const Sweep& sweep, const CircuitFit& fit) {
  std::vector<CircuitFit> fits;
  constexpr unsigned combinations = 1U << std::size(parts_of_phase);
  for (unsigned set = 1; set < combinations; ++set) {
    std::vector<Part> turning;
    for (unsigned i = 0; i < std::size(parts_of_phase); ++i) {
      if ((set >> i & 1U) != 0) {
        turning.push_back(parts_of_phase[i]);
      }
    }
    if (std::optional<CircuitFit> turned = turned_fit(sweep, fit, turning)) {
      fits.push_back(*std::move(turned));
    }
  }
  return fits;
}

}  // namespace sonoglide::identify::impedance
