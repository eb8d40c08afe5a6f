#include "host_sim/studies/identify/impedance/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/studies/identify/least_squares.hpp"

namespace sonoglide::identify::impedance {
namespace {

/// A positive figure and the slopes of its logarithm to ln C0 and the first mode's ln G, ln fs, ln Δ.
struct Figure {
  const char* name;
  double value;
  Eigen::Vector4d slopes;
};

std::vector<Figure> electrical(const Circuit& circuit) {
  const Mode& mode = circuit.modes.front();
  const double k2 = circuit.coupling() * circuit.coupling();  // C1/(C0 + C1)
  const Eigen::Vector4d ratio = {-1.0, 1.0, -2.0, 1.0};       // of C1/C0
  return {{"clamped_capacitance_F", circuit.clamped_capacitance_F, {1.0, 0.0, 0.0, 0.0}},
          {"motional_resistance_ohm", mode.resistance_ohm(), {0.0, -1.0, 0.0, 0.0}},
          {"motional_inductance_H", mode.inductance_H(), {0.0, -1.0, 0.0, -1.0}},
          {"motional_capacitance_F", mode.capacitance_F(), {0.0, 1.0, -2.0, 1.0}},
          {"resonance_frequency_Hz", mode.resonance_Hz, {0.0, 0.0, 1.0, 0.0}},
          {"antiresonance_frequency_Hz", circuit.antiresonance_Hz(),
           Eigen::Vector4d::Unit(2) + 0.5 * k2 * ratio},
          {"quality_factor", mode.quality(), {0.0, 0.0, 1.0, -1.0}},
          {"coupling", circuit.coupling(), 0.5 * (1.0 - k2) * ratio}};
}

void require_in_range(const char* what, double value, const Range& range, const char* unit) {
  if (value < range.least || value > range.most) {
    throw loop::ComputationError(
        fmt::format("identify impedance: a {} of {:.3g} {} follows from what is given; allowed: "
                    "{:g} to {:g}",
                    what, value, unit, range.least, range.most));
  }
}

std::vector<Figure> mechanical(const Mode& mode, const MechanicalFact& fact) {
  const double squared =
      fact.mass_kg ? *fact.mass_kg / mode.inductance_H()
                   : fact.force_factor_N_per_V.value() * fact.force_factor_N_per_V.value();
  const double mass_kg = squared * mode.inductance_H();
  const double force_factor_N_per_V = std::sqrt(squared);
  require_in_range("mass", mass_kg, mass_range_kg, "kg");
  require_in_range("force factor", force_factor_N_per_V, force_factor_range_N_per_V, "N/V");
  // Of Nf²: with a known mass that of 1/L1.
  const Eigen::Vector4d nf2 = Eigen::Vector4d(0.0, 1.0, 0.0, 1.0) * (fact.mass_kg ? 1.0 : 0.0);
  return {{"mass_kg", mass_kg, nf2 + Eigen::Vector4d(0.0, -1.0, 0.0, -1.0)},
          {"stiffness_N_per_m", squared / mode.capacitance_F(),
           nf2 + Eigen::Vector4d(0.0, -1.0, 2.0, -1.0)},
          {"damping_N_s_per_m", squared * mode.resistance_ohm(),
           nf2 + Eigen::Vector4d(0.0, -1.0, 0.0, 0.0)},
          {"force_factor_N_per_V", force_factor_N_per_V, 0.5 * nf2}};
}

/// Of noise that hangs together a figure sees the slow part more, of which a sweep has fewer pieces:
/// Satterthwaite's degrees of freedom of both.
double t_of(const CircuitFit& fit) {
  const auto rows = static_cast<double>(fit.at.residuals.size());
  const double longer = (1.0 + fit.noise.memory) / (1.0 - fit.noise.memory);
  const double slow = fit.noise.correlated_share * longer;
  const double white = 1.0 - fit.noise.correlated_share;
  const double freedom = rows * std::pow(slow + white, 2) / (slow * slow * longer + white * white);
  return student_t_95(std::max(freedom - static_cast<double>(fit.parts.size()), 3.0));
}

Estimate estimate(const CircuitFit& fit, const Figure& figure) {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(fit.covariance.rows());
  gradient(0) = figure.slopes(0);
  gradient.segment<3>(first_mode) = figure.slopes.tail<3>();
  const double variance = gradient.dot(fit.covariance * gradient);
  const double half = t_of(fit) * std::sqrt(std::max(variance, 0.0));
  return {figure.name, figure.value, figure.value * std::exp(-half), figure.value * std::exp(half)};
}

}  // namespace

std::vector<Estimate> figures(const CircuitFit& fit, const MechanicalFact& fact) {
  std::vector<Estimate> estimates;
  for (const Figure& each : electrical(fit.circuit)) {
    estimates.push_back(estimate(fit, each));
  }
  const Eigen::VectorXd p = to_vector(fit.circuit);
  for (std::size_t i = 0; i < part_count; ++i) {
    const auto part = static_cast<Part>(i);
    if (fit.parts.has(part)) {
      const Eigen::Index at = index_of(part);
      const double half = t_of(fit) * std::sqrt(fit.covariance(at, at));
      estimates.push_back({name_of(part), p(at), p(at) - half, p(at) + half, true});
    }
  }
  if (fact.known()) {
    for (const Figure& each : mechanical(fit.circuit.modes.front(), fact)) {
      estimates.push_back(estimate(fit, each));
    }
  }
  return estimates;
}

bool is_open(const Estimate& estimate) {
  constexpr double most = 10.0;
  return !estimate.may_be_0 && !(estimate.high_95 <= most * estimate.low_95);
}

}  // namespace sonoglide::identify::impedance
