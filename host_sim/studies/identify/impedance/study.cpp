#include "host_sim/studies/identify/impedance/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host_sim/studies/identify/impedance/figures.hpp"
#include "host_sim/studies/identify/impedance/selection.hpp"
#include "host_sim/studies/identify/least_squares.hpp"

namespace sonoglide::identify::impedance {
namespace {

/// At most most_readings of a sweep, evenly, with all readings about the largest G/f (|Y|/f).
Sweep thinned(const Sweep& sweep) {
  const std::size_t n = sweep.frequency_Hz.size();
  if (n <= most_readings) {
    return sweep;
  }
  std::size_t peak = 0;
  double highest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto y = sweep.admittance_S[i];
    const double height = (sweep.has_phase ? y.real() : std::abs(y)) / sweep.frequency_Hz[i];
    if (height > highest) {
      highest = height;
      peak = i;
    }
  }
  constexpr std::size_t about = most_readings / 3;
  const std::size_t stride = 1 + n / (most_readings - about);
  Sweep left = sweep;
  left.frequency_Hz.clear();
  left.admittance_S.clear();
  for (std::size_t i = 0; i < n; ++i) {
    if (i % stride == 0 || (i + about / 2 >= peak && i <= peak + about / 2)) {
      left.frequency_Hz.push_back(sweep.frequency_Hz[i]);
      left.admittance_S.push_back(sweep.admittance_S[i]);
    }
  }
  left.warnings.push_back(
      fmt::format("Of {} readings {} are used: every {}th, and all about the largest conductance.",
                  n, left.frequency_Hz.size(), stride));
  return left;
}

double root_mean_square(const CircuitFit& fit) {
  const auto readings = static_cast<double>(fit.at.log_magnitude.size());
  return std::sqrt(fit.at.residuals.squaredNorm() / readings);
}

std::size_t readings_in_band(const Sweep& sweep, const Mode& mode) {
  return static_cast<std::size_t>(std::count_if(
      sweep.frequency_Hz.begin(), sweep.frequency_Hz.end(),
      [&](double f) { return std::abs(f - mode.resonance_Hz) <= 0.5 * mode.bandwidth_Hz; }));
}

/// Deviation of a phase residual from the one before it: what is no misfit.
double reading_to_reading(const CircuitFit& fit) {
  const Eigen::Index n = fit.at.log_magnitude.size();
  std::vector<double> steps;
  for (Eigen::Index i = n + 1; i < fit.at.residuals.size(); ++i) {
    steps.push_back(std::abs(fit.at.residuals(i) - fit.at.residuals(i - 1)));
  }
  constexpr double deviation_of_median = 1.4826;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return deviation_of_median * *middle / std::sqrt(2.0);
}

/// Readings whose phase is beyond ±90° by more than the scatter explains.
std::size_t impossible_phases(const Sweep& sweep, const CircuitFit& fit) {
  const double scatter = 4.0 * reading_to_reading(fit);
  return static_cast<std::size_t>(std::count_if(
      sweep.admittance_S.begin(), sweep.admittance_S.end(),
      [&](std::complex<double> y) { return y.real() < -std::abs(y) * std::max(scatter, 1e-3); }));
}

void warn_of_phases(const Sweep& sweep, const CircuitFit& fit, std::vector<std::string>& warnings) {
  if (!sweep.has_phase) {
    return;
  }
  const std::size_t impossible = impossible_phases(sweep, fit);
  if (impossible > 0) {
    warnings.push_back(
        fmt::format("{} of {} readings have a phase beyond 90 degrees: no passive part has one. "
                    "It is an error of the fixture or of its compensation; compensate it (open, "
                    "short, load) and measure again.",
                    impossible, sweep.frequency_Hz.size()));
  }
  const double deviation = std::sqrt(fit.covariance(1, 1));
  const double tangent = fit.circuit.loss_tangent;
  constexpr double many = 4.0;
  if (tangent < -many * deviation && tangent < 0.0) {
    warnings.push_back(
        fmt::format("The loss tangent comes out negative, {:.3g}: the phase is off by about {:.2g} "
                    "degrees, which is the fixture's error.",
                    tangent, std::abs(tangent) * 360.0 / two_pi));
  }
}

void warn_of_sweep(const Sweep& sweep, const CircuitFit& fit, std::vector<std::string>& warnings) {
  const Mode& mode = fit.circuit.modes.front();
  const std::size_t inside = readings_in_band(sweep, mode);
  constexpr std::size_t few = 5;
  if (inside < few) {
    warnings.push_back(fmt::format(
        "{} readings lie in the band width of {} about the resonance: resistance and "
        "quality factor rest on them. Measure at steps of {} or finer there.",
        inside, shown("_Hz", mode.bandwidth_Hz), shown("_Hz", mode.bandwidth_Hz / few)));
  }
  const double parallel_Hz = fit.circuit.antiresonance_Hz();
  if (parallel_Hz > sweep.frequency_Hz.back()) {
    warnings.push_back(fmt::format(
        "The parallel resonance at {} is above the sweep, which ends at {}: the clamped "
        "capacitance and the coupling rest on the flank alone.",
        shown("_Hz", parallel_Hz), shown("_Hz", sweep.frequency_Hz.back())));
  }
}

void warn_of_other_modes(const CircuitFit& fit, std::vector<std::string>& warnings) {
  for (std::size_t i = 1; i < fit.circuit.modes.size(); ++i) {
    const Mode& mode = fit.circuit.modes[i];
    warnings.push_back(fmt::format(
        "Another mode at {} (quality factor {:.3g}, {}) is in the sweep; it is fitted and is not "
        "part of the figures.",
        shown("_Hz", mode.resonance_Hz), mode.quality(), shown("_ohm", mode.resistance_ohm())));
  }
}

std::vector<std::string> open_questions(const std::vector<Estimate>& estimates, const Sweep& sweep,
                                        const MechanicalFact& fact) {
  std::vector<std::string> open;
  if (!fact.known()) {
    open.emplace_back(
        "Mass, stiffness, damping and force factor: electrical data give m/Nf^2, Nf^2/Ks and "
        "c/Nf^2 "
        "alone. One mechanical fact tells them: --mass-kg, or --force-factor-N-per-V.");
  }
  if (!sweep.has_phase) {
    open.emplace_back(
        "Losses of the dielectric: magnitudes alone hardly part them from the motional resistance. "
        "A sweep with phase does.");
  }
  for (const Estimate& each : estimates) {
    constexpr double twice = 2.0;
    if (each.name != "loss_tangent" &&
        !(each.high_95 < twice * each.value && each.low_95 > each.value / twice)) {
      open.push_back(fmt::format("{}: its interval goes from {} to {}.", each.name,
                                 shown(each.name, each.low_95), shown(each.name, each.high_95)));
    }
    if (each.name == "loss_tangent" && each.low_95 < 0.0 && each.high_95 > 0.0) {
      open.push_back(
          fmt::format("Whether the dielectric has losses: the loss tangent is within "
                      "{:.2g} of 0.",
                      std::max(-each.low_95, each.high_95)));
    }
  }
  return open;
}

Correlations correlations_of(const CircuitFit& fit) {
  Correlations result;
  result.names.emplace_back("ln clamped_capacitance_F");
  if (fit.parts.loss_tangent) {
    result.names.emplace_back("loss_tangent");
  }
  for (int mode = 1; mode <= fit.parts.modes; ++mode) {
    const std::string number = mode == 1 ? "" : fmt::format(" of mode {}", mode);
    for (const char* name :
         {"ln motional_conductance_S", "ln resonance_frequency_Hz", "ln bandwidth_Hz"}) {
      result.names.push_back(name + number);
    }
  }
  const Eigen::MatrixXd matrix = correlations(fit.covariance);
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    result.rows.emplace_back(matrix.row(i).begin(), matrix.row(i).end());
  }
  return result;
}

std::string model_of(const CircuitFit& fit) {
  return fmt::format("clamped capacitance{} beside {}",
                     fit.parts.loss_tangent ? " with a loss tangent" : "",
                     fit.parts.modes == 1 ? std::string("one motional branch")
                                          : fmt::format("{} motional branches", fit.parts.modes));
}

}  // namespace

ImpedanceStudy study(const std::string& name, const Sweep& measured, const MechanicalFact& fact) {
  Selection selected = select_circuit(thinned(measured));
  ImpedanceStudy result{name, std::move(selected.sweep), std::move(selected.fit), fact, {}};
  Identification& identification = result.identification;
  identification.subject = "impedance";
  identification.model = model_of(result.fit);
  identification.parameters = figures(result.fit);
  identification.residual_rms = root_mean_square(result.fit);
  identification.misfit =
      identification.residual_rms * std::sqrt(result.fit.noise.correlated_share);
  identification.correlations = correlations_of(result.fit);
  identification.warnings = result.sweep.warnings;
  if (!selected.left_out.empty()) {
    identification.warnings.push_back(
        fmt::format("Left out, as standing alone far off the readings beside them: {}.",
                    selected.left_out.size()));
  }
  warn_of_phases(result.sweep, result.fit, identification.warnings);
  warn_of_sweep(result.sweep, result.fit, identification.warnings);
  warn_of_other_modes(result.fit, identification.warnings);
  identification.cannot_tell = open_questions(identification.parameters, result.sweep, fact);
  if (fact.known()) {
    const std::vector<Estimate> mechanical = mechanical_figures(result.fit, fact);
    identification.parameters.insert(identification.parameters.end(), mechanical.begin(),
                                     mechanical.end());
  }
  return result;
}

}  // namespace sonoglide::identify::impedance
