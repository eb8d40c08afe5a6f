#include "host_sim/studies/identify/impedance/figures.hpp"

#include <algorithm>
#include <cmath>
#include <string>

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
  const Eigen::Index first = first_mode(fit.parts);
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

double t_of(const CircuitFit& fit) {
  return student_t_95(static_cast<double>(fit.at.residuals.size() - fit.p.size()));
}

Estimate estimate(const CircuitFit& fit, const Figure& figure) {
  const double variance = figure.gradient.dot(fit.covariance * figure.gradient);
  const double half = t_of(fit) * std::sqrt(std::max(variance, 0.0));
  return {figure.name, figure.value, figure.value * std::exp(-half), figure.value * std::exp(half)};
}

}  // namespace

std::vector<Estimate> figures(const CircuitFit& fit) {
  std::vector<Estimate> estimates;
  for (const Figure& each : positive_figures(fit)) {
    estimates.push_back(estimate(fit, each));
  }
  if (fit.parts.loss_tangent) {
    const double half = t_of(fit) * std::sqrt(fit.covariance(1, 1));
    estimates.push_back({"loss_tangent", fit.circuit.loss_tangent, fit.circuit.loss_tangent - half,
                         fit.circuit.loss_tangent + half});
  }
  return estimates;
}

std::vector<Estimate> mechanical_figures(const CircuitFit& fit, const MechanicalFact& fact) {
  const Eigen::Index size = fit.p.size();
  const Eigen::Index first = first_mode(fit.parts);
  const Eigen::VectorXd g = Eigen::VectorXd::Unit(size, first);
  const Eigen::VectorXd f = Eigen::VectorXd::Unit(size, first + 1);
  const Eigen::VectorXd bandwidth = Eigen::VectorXd::Unit(size, first + 2);
  const Mode& mode = fit.circuit.modes.front();
  const double squared =
      fact.mass_kg ? *fact.mass_kg / mode.inductance_H()
                   : fact.force_factor_N_per_V.value() * fact.force_factor_N_per_V.value();
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
