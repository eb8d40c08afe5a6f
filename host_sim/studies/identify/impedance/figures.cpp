#include "host_sim/studies/identify/impedance/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/studies/identify/distributions.hpp"

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

/// What one of the circuits makes of a figure: a Gaussian.
struct Belief {
  double centre;
  double deviation;
  double weight;  ///< its probability
};

/// Where the mixture of Gaussians has so much probability below. By bisection, because the distribution jumps at the
/// 0 of circuits without the part.
double quantile(const std::vector<Belief>& all, double probability) {
  constexpr double far = 10.0;
  double low = all.front().centre;
  double high = low;
  for (const Belief& each : all) {
    low = std::min(low, each.centre - far * each.deviation);
    high = std::max(high, each.centre + far * each.deviation);
  }
  constexpr int halvings = 60;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    double below = 0.0;
    for (const Belief& each : all) {
      const double away = (each.centre - middle) / std::max(each.deviation, 1e-300);
      below += each.weight * 0.5 * std::erfc(std::sqrt(0.5) * away);
    }
    (below < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

struct Interval {
  double low;
  double high;
};

/// Of 95 %: of one Gaussian by Student's t, of a mixture between the quantiles, each deviation wider by
/// as much as t is than that of a Gaussian. It has the centre of the fit, the last one, in it.
Interval interval_of(std::vector<Belief> all, double t) {
  const Belief fitted = all.back();
  const double half = t * fitted.deviation;
  if (all.size() == 1) {
    return {fitted.centre - half, fitted.centre + half};
  }
  constexpr double of_gaussian = 1.959964;
  for (Belief& each : all) {
    each.deviation *= t / of_gaussian;
  }
  constexpr double tail = 0.025;
  return {std::min(quantile(all, tail), fitted.centre),
          std::max(quantile(all, 1.0 - tail), fitted.centre)};
}

/// The circuits that the intervals are of, the fit's own last.
std::vector<Alternative> circuits_of(const CircuitFit& fit) {
  return fit.alternatives.empty() ? std::vector<Alternative>{{fit.circuit, fit.covariance, 1.0}}
                                  : fit.alternatives;
}

double deviation(const Figure& figure, const Eigen::MatrixXd& covariance) {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(covariance.rows());
  gradient(0) = figure.slopes(0);
  gradient.segment<3>(first_mode) = figure.slopes.tail<3>();
  return std::sqrt(std::max(gradient.dot(covariance * gradient), 0.0));
}

/// Of positive figures, symmetric in the logarithm where there is one circuit.
/// @param figures_of  the figures of a circuit
template <class Figures>
void append_positive(const CircuitFit& fit, const Figures& figures_of,
                     std::vector<Estimate>& estimates) {
  const std::vector<Figure> fitted = figures_of(fit.circuit);
  std::vector<std::vector<Belief>> beliefs(fitted.size());
  for (const Alternative& each : circuits_of(fit)) {
    const std::vector<Figure> found = figures_of(each.circuit);
    for (std::size_t i = 0; i < found.size(); ++i) {
      beliefs[i].push_back(
          {std::log(found[i].value), deviation(found[i], each.covariance), each.weight});
    }
  }
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    const Interval interval = interval_of(beliefs[i], t_of(fit));
    estimates.push_back(
        {fitted[i].name, fitted[i].value, std::exp(interval.low), std::exp(interval.high)});
  }
}

Estimate part_estimate(const CircuitFit& fit, Part part) {
  const Eigen::Index at = index_of(part);
  std::vector<Belief> beliefs;
  for (const Alternative& each : circuits_of(fit)) {
    beliefs.push_back(
        {to_vector(each.circuit)(at), std::sqrt(each.covariance(at, at)), each.weight});
  }
  const Interval interval = interval_of(beliefs, t_of(fit));
  return {name_of(part), beliefs.back().centre, interval.low, interval.high, true};
}

}  // namespace

std::vector<Estimate> figures(const CircuitFit& fit, const MechanicalFact& fact) {
  std::vector<Estimate> estimates;
  append_positive(fit, electrical, estimates);
  for (std::size_t i = 0; i < part_count; ++i) {
    const auto part = static_cast<Part>(i);
    if (fit.parts.has(part)) {
      estimates.push_back(part_estimate(fit, part));
    }
  }
  if (fact.known()) {
    append_positive(
        fit, [&](const Circuit& each) { return mechanical(each.modes.front(), fact); }, estimates);
  }
  return estimates;
}

bool is_open(const Estimate& estimate) {
  constexpr double most = 10.0;
  return !estimate.may_be_0 && !(estimate.high_95 <= most * estimate.low_95);
}

}  // namespace sonoglide::identify::impedance
