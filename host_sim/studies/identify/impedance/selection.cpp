#include "host_sim/studies/identify/impedance/selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <limits>
#include <optional>

#include "host_sim/loop/failure.hpp"
#include "host_sim/studies/identify/impedance/start_values.hpp"
#include "host_sim/studies/identify/least_squares.hpp"

namespace sonoglide::identify::impedance {
namespace {

[[noreturn]] void refuse(const std::string& reason) {
  throw loop::ComputationError("identify impedance: " + reason);
}

/// The converged fit of the least deviance.
std::optional<CircuitFit> best_fit(const Sweep& sweep, Parts parts,
                                   const std::vector<Circuit>& starts, const Noise& noise) {
  std::optional<CircuitFit> best;
  for (const Circuit& start : starts) {
    CircuitFit fit = fit_circuit(sweep, parts, start, noise);
    if (fit.converged && (!best || fit.deviance < best->deviance)) {
      best = std::move(fit);
    }
  }
  return best;
}

/// How likely chance alone lowers the deviance as much.
double chance(const CircuitFit& smaller, const CircuitFit& larger) {
  const auto rows = static_cast<double>(larger.at.residuals.size());
  const double freedom = rows - static_cast<double>(larger.p.size());
  const auto more = static_cast<double>(larger.p.size() - smaller.p.size());
  const double f = std::expm1((smaller.deviance - larger.deviance) / rows) * freedom / more;
  return f > 0.0 && std::isfinite(f)
             ? boost::math::cdf(boost::math::complement(boost::math::fisher_f(more, freedom), f))
             : (f > 0.0 ? 0.0 : 1.0);
}

/// Readings in the band width of a mode, twice as wide as that.
std::size_t readings_near(const Sweep& sweep, const Mode& mode) {
  return static_cast<std::size_t>(
      std::count_if(sweep.frequency_Hz.begin(), sweep.frequency_Hz.end(),
                    [&](double f) { return std::abs(f - mode.resonance_Hz) < mode.bandwidth_Hz; }));
}

bool plausible(const Sweep& sweep, const CircuitFit& fit) {
  const Mode& added = fit.circuit.modes.back();
  constexpr std::size_t fewest = 3;
  return added.resonance_Hz > 0.5 * sweep.frequency_Hz.front() &&
         added.resonance_Hz < 2.0 * sweep.frequency_Hz.back() && added.quality() > 0.5 &&
         readings_near(sweep, added) >= fewest;
}

/// The fit with the mode that its residuals ask for most, where there is a plausible one.
std::optional<CircuitFit> with_another_mode(const Sweep& sweep, const CircuitFit& fit) {
  constexpr std::size_t tries = 3;
  Parts parts = fit.parts;
  ++parts.modes;
  if (parts.modes > most_modes || 2 * parameters(parts) > fit.at.residuals.size()) {
    return std::nullopt;
  }
  std::optional<CircuitFit> larger =
      best_fit(sweep, parts, circuits_with_another_mode(sweep, fit, tries), fit.noise);
  if (larger) {
    *larger = fit_circuit_and_noise(sweep, parts, larger->circuit, larger->noise);
  }
  return larger && larger->converged && plausible(sweep, *larger) ? larger : std::nullopt;
}

bool is_seen(const Sweep& sweep, const CircuitFit& fit, const CircuitFit& larger) {
  return chance(fit, larger) * static_cast<double>(sweep.frequency_Hz.size()) <= mode_significance;
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

/// What a mode that is not certain adds to the covariance: the larger fit counts by its likelihood
/// against the smaller one's, less what its parameters cost (Schwarz), with its own covariance and
/// the square of the step to it.
/// Source: Kass and Raftery, Journal of the American Statistical Association 90 (1995).
void allow_for_mode(const CircuitFit& larger, CircuitFit& fit) {
  const Eigen::Index size = fit.p.size();
  const auto rows = static_cast<double>(fit.at.residuals.size());
  const double log_odds = 0.5 * (fit.deviance - larger.deviance) -
                          0.5 * static_cast<double>(larger.p.size() - size) * std::log(rows);
  const double weight = 1.0 / (1.0 + std::exp(-log_odds));
  const Eigen::VectorXd step = larger.p.head(size) - fit.p;
  const Eigen::MatrixXd other =
      larger.covariance.topLeftCorner(size, size) + step * step.transpose();
  if (other.allFinite()) {
    fit.covariance = (1.0 - weight) * fit.covariance + weight * other;
  }
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The lesser of the distances of each value to those beside it.
std::vector<double> distances_to_neighbours(const Eigen::VectorXd& r) {
  std::vector<double> apart;
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    const double before = r(i > 0 ? i - 1 : 1);
    const double after = r(i + 1 < r.size() ? i + 1 : i - 1);
    apart.push_back(std::min(std::abs(r(i) - before), std::abs(r(i) - after)));
  }
  return apart;
}

/// Readings whose relative residual alone is far off those on both sides, measured by what is usual
/// around them.
std::vector<std::size_t> find_strays(const CircuitFit& fit) {
  const Eigen::Index n = fit.at.log_magnitude.size();
  constexpr double far = 8.0;
  constexpr double deviation_of_median = 1.4826;
  constexpr std::ptrdiff_t around = 15;
  std::vector<std::size_t> strays;
  for (Eigen::Index begin = 0; begin < fit.at.residuals.size(); begin += n) {
    const Eigen::VectorXd r = fit.at.residuals.segment(begin, n);
    const std::vector<double> apart = distances_to_neighbours(r);
    for (std::size_t i = 0; i < apart.size(); ++i) {
      const auto at = static_cast<std::ptrdiff_t>(i);
      const auto size = static_cast<std::ptrdiff_t>(apart.size());
      const double usual = median({apart.begin() + std::max<std::ptrdiff_t>(at - around, 0),
                                   apart.begin() + std::min(at + around + 1, size)});
      // Beside a stray the distance to it is large too, the own residual is not.
      if (apart[i] > far * deviation_of_median * std::max(usual, 1e-300) &&
          std::abs(r(at)) > 0.5 * apart[i]) {
        strays.push_back(i);
      }
    }
  }
  std::sort(strays.begin(), strays.end());
  strays.erase(std::unique(strays.begin(), strays.end()), strays.end());
  return strays;
}

Sweep without(const Sweep& sweep, const std::vector<std::size_t>& strays) {
  Sweep left = sweep;
  for (auto each = strays.rbegin(); each != strays.rend(); ++each) {
    left.frequency_Hz.erase(left.frequency_Hz.begin() + static_cast<std::ptrdiff_t>(*each));
    left.admittance_S.erase(left.admittance_S.begin() + static_cast<std::ptrdiff_t>(*each));
  }
  return left;
}

/// A capacitor with loss, its value such that the mean deviation is nothing.
Circuit capacitor(const Sweep& sweep) {
  double sum = 0.0;
  for (std::size_t i = 0; i < sweep.frequency_Hz.size(); ++i) {
    sum += std::log(std::abs(sweep.admittance_S[i]) / (two_pi * sweep.frequency_Hz[i]));
  }
  return {std::exp(sum / static_cast<double>(sweep.frequency_Hz.size())), 0.0, {}};
}

void require_resonance(const Sweep& sweep, const CircuitFit& fit) {
  const CircuitFit none =
      fit_circuit_and_noise(sweep, {fit.parts.loss_tangent, 0}, capacitor(sweep), Noise{});
  const auto searched = static_cast<double>(sweep.frequency_Hz.size());
  if (none.converged && chance(none, fit) * searched > mode_significance) {
    refuse(fmt::format(
        "no resonance is seen from {:.6g} to {:.6g} Hz: a capacitance of {:.4g} F alone "
        "fits as well",
        sweep.frequency_Hz.front(), sweep.frequency_Hz.back(), none.circuit.clamped_capacitance_F));
  }
}

void require_inside(const Sweep& sweep, const CircuitFit& fit) {
  const Mode& mode = *std::max_element(
      fit.circuit.modes.begin(), fit.circuit.modes.end(),
      [](const Mode& a, const Mode& b) { return a.conductance_S < b.conductance_S; });
  const double low_Hz = sweep.frequency_Hz.front();
  const double high_Hz = sweep.frequency_Hz.back();
  if (mode.resonance_Hz < low_Hz || mode.resonance_Hz > high_Hz) {
    refuse(
        fmt::format("the fit ends at a bound: its resonance at {:.6g} Hz is not in the sweep, "
                    "which goes from {:.6g} to {:.6g} Hz; measure across the resonance",
                    mode.resonance_Hz, low_Hz, high_Hz));
  }
  constexpr double least_quality = 0.5;
  constexpr double most_quality = 1e7;
  if (mode.quality() < least_quality || mode.quality() > most_quality) {
    refuse(
        fmt::format("the fit ends at a bound: a quality factor of {:.3g}, allowed: {:g} to {:g}; "
                    "the sweep does not tell the resistance",
                    mode.quality(), least_quality, most_quality));
  }
  constexpr double most_ratio = 1e3;
  const double ratio = mode.capacitance_F() / fit.circuit.clamped_capacitance_F;
  if (ratio < 1e-9 || ratio > most_ratio) {
    refuse(
        fmt::format("the fit ends at a bound: motional over clamped capacitance of {:.3g}, "
                    "allowed: 1e-9 to {:g}; the sweep does not tell them apart",
                    ratio, most_ratio));
  }
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

CircuitFit first_fit(const Sweep& sweep) {
  constexpr std::size_t tries = 4;
  std::optional<CircuitFit> fit =
      best_fit(sweep, {sweep.has_phase, 1}, start_circuits(sweep, tries), Noise{});
  if (!fit) {
    refuse("no circuit fits the sweep: the least squares do not converge from any start");
  }
  CircuitFit noisy = fit_circuit_and_noise(sweep, fit->parts, fit->circuit, Noise{});
  return noisy.converged ? noisy : *fit;
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

}  // namespace

Selection select_circuit(const Sweep& sweep) {
  Selection selected{first_fit(sweep), sweep, {}};
  require_resonance(sweep, selected.fit);
  selected.left_out = find_strays(selected.fit);
  if (!selected.left_out.empty() && selected.left_out.size() * 20 < sweep.frequency_Hz.size()) {
    selected.sweep = without(sweep, selected.left_out);
    selected.fit = first_fit(selected.sweep);
  } else {
    selected.left_out.clear();
  }
  std::optional<CircuitFit> larger = with_another_mode(selected.sweep, selected.fit);
  while (larger && is_seen(selected.sweep, selected.fit, *larger)) {
    selected.fit = *std::move(larger);
    larger = with_another_mode(selected.sweep, selected.fit);
  }
  if (!sweep.has_phase) {
    add_loss(selected.sweep, selected.fit);
  }
  require_inside(selected.sweep, selected.fit);
  selected.fit.covariance = allow_for_correlation(selected.fit.at, selected.fit.noise).covariance;
  if (larger && larger->parts.loss_tangent == selected.fit.parts.loss_tangent &&
      stands_apart(*larger)) {
    allow_for_mode(*larger, selected.fit);
  }
  put_largest_first(selected.fit);
  return selected;
}

}  // namespace sonoglide::identify::impedance
