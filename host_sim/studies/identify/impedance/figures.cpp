#include "host_sim/studies/identify/impedance/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "host_sim/loop/failure.hpp"
#include "host_sim/studies/identify/impedance/mechanics.hpp"
#include "host_sim/studies/identify/least_squares.hpp"

namespace sonoglide::identify::impedance {
namespace {

/// A positive figure and the gradient of its logarithm.
struct Figure {
  std::string name;
  double value;
  Eigen::VectorXd gradient;
};

std::vector<Figure> positive_figures(const CircuitFit& fit) {
  const Eigen::Index size = fit.p.size();
  const Eigen::VectorXd c0 = Eigen::VectorXd::Unit(size, 0);
  const Eigen::Index first = fit.parts.first_mode();
  const Eigen::VectorXd g = Eigen::VectorXd::Unit(size, first);
  const Eigen::VectorXd f = Eigen::VectorXd::Unit(size, first + 1);
  const Eigen::VectorXd bandwidth = Eigen::VectorXd::Unit(size, first + 2);
  const Eigen::VectorXd c1 = g + bandwidth - 2.0 * f;
  const Circuit& circuit = fit.circuit;
  const Mode& mode = circuit.modes.front();
  const double k2 = circuit.coupling() * circuit.coupling();  // C1/(C0 + C1)
  return {{"clamped_capacitance_F", circuit.clamped_capacitance_F, c0},
          {"motional_resistance_ohm", mode.resistance_ohm(), -g},
          {"motional_inductance_H", mode.inductance_H(), -g - bandwidth},
          {"motional_capacitance_F", mode.capacitance_F(), c1},
          {"resonance_frequency_Hz", mode.resonance_Hz, f},
          {"antiresonance_frequency_Hz", circuit.antiresonance_Hz(), f + 0.5 * k2 * (c1 - c0)},
          {"quality_factor", mode.quality(), f - bandwidth},
          {"coupling", circuit.coupling(), 0.5 * (1.0 - k2) * (c1 - c0)}};
}

/// Of noise that hangs together a figure sees the slow part more, of which a sweep has fewer pieces:
/// Satterthwaite's degrees of freedom of both.
double t_of(const CircuitFit& fit) {
  const auto rows = static_cast<double>(fit.at.residuals.size());
  const double longer = (1.0 + fit.noise.memory) / (1.0 - fit.noise.memory);
  const double slow = fit.noise.correlated_share * longer;
  const double white = 1.0 - fit.noise.correlated_share;
  const double freedom = rows * std::pow(slow + white, 2) / (slow * slow * longer + white * white);
  return student_t_95(std::max(freedom - static_cast<double>(fit.p.size()), 3.0));
}

Estimate estimate(const CircuitFit& fit, const Figure& figure) {
  const double variance = figure.gradient.dot(fit.covariance * figure.gradient);
  const double half = t_of(fit) * std::sqrt(std::max(variance, 0.0));
  return {figure.name, figure.value, figure.value * std::exp(-half), figure.value * std::exp(half)};
}

void require_in_range(const char* what, double value, const Range& range, const char* unit) {
  if (value < range.least || value > range.most) {
    throw loop::ComputationError(
        fmt::format("identify impedance: a {} of {:.3g} {} follows from what is given; allowed: "
                    "{:g} to {:g}",
                    what, value, unit, range.least, range.most));
  }
}

}  // namespace

std::vector<Estimate> figures(const CircuitFit& fit) {
  std::vector<Estimate> estimates;
  for (const Figure& each : positive_figures(fit)) {
    estimates.push_back(estimate(fit, each));
  }
  for (std::size_t i = 0; i < part_count; ++i) {
    const auto part = static_cast<Part>(i);
    if (fit.parts.has(part)) {
      const Eigen::Index at = fit.parts.index(part);
      const double half = t_of(fit) * std::sqrt(fit.covariance(at, at));
      estimates.push_back({name_of(part), fit.p(at), fit.p(at) - half, fit.p(at) + half});
    }
  }
  return estimates;
}

bool may_be_0(const Estimate& estimate) {
  for (std::size_t i = 0; i < part_count; ++i) {
    if (estimate.name == name_of(static_cast<Part>(i))) {
      return true;
    }
  }
  return false;
}

bool is_open(const Estimate& estimate) {
  constexpr double most = 10.0;
  return !may_be_0(estimate) && !(estimate.high_95 <= most * estimate.low_95);
}

std::vector<Estimate> mechanical_figures(const CircuitFit& fit, const MechanicalFact& fact) {
  const Eigen::Index size = fit.p.size();
  const Eigen::Index first = fit.parts.first_mode();
  const Eigen::VectorXd g = Eigen::VectorXd::Unit(size, first);
  const Eigen::VectorXd f = Eigen::VectorXd::Unit(size, first + 1);
  const Eigen::VectorXd bandwidth = Eigen::VectorXd::Unit(size, first + 2);
  const Mode& mode = fit.circuit.modes.front();
  const double squared =
      fact.mass_kg ? *fact.mass_kg / mode.inductance_H()
                   : fact.force_factor_N_per_V.value() * fact.force_factor_N_per_V.value();
  require_in_range("mass", squared * mode.inductance_H(), mass_range_kg, "kg");
  require_in_range("force factor", std::sqrt(squared), force_factor_range_N_per_V, "N/V");
  // d ln Nf²: of a known mass −d ln L1.
  const Eigen::VectorXd factor =
      fact.mass_kg ? Eigen::VectorXd(g + bandwidth) : Eigen::VectorXd(Eigen::VectorXd::Zero(size));
  return {estimate(fit, {"mass_kg", squared * mode.inductance_H(), factor - g - bandwidth}),
          estimate(fit, {"stiffness_N_per_m", squared / mode.capacitance_F(),
                         factor - g - bandwidth + 2.0 * f}),
          estimate(fit, {"damping_N_s_per_m", squared * mode.resistance_ohm(), factor - g}),
          estimate(fit, {"force_factor_N_per_V", std::sqrt(squared), 0.5 * factor})};
}

}  // namespace sonoglide::identify::impedance
