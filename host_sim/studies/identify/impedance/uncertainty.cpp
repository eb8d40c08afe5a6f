#include "host_sim/studies/identify/impedance/selection.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "host_sim/studies/identify/least_squares.hpp"

namespace sonoglide::identify::impedance {
namespace {

/// What a part that is not fitted may be, by its linearisation; a resistance of leads in place of a
/// rotation that is not seen.
Unseen unseen_part(const Sweep& sweep, const CircuitFit& fit, Part part) {
  Parts larger = fit.parts.with(part);
  Circuit circuit = fit.circuit;
  if (part == Part::lead_resistance && !sees(fit, Part::rotation)) {
    larger = larger.with(Part::rotation, false);
    circuit.rotation_rad = 0.0;
  }
  const Solution solution = solve(linearise(sweep, larger, circuit), fit.noise);
  const Eigen::VectorXd step = over_vector(solution.step.asDiagonal(), larger).diagonal();
  const Eigen::MatrixXd covariance = over_vector(solution.covariance, larger);
  const Eigen::Index at = index_of(part);
  constexpr double deviations = 2.0;
  const double seen = part == Part::lean ? std::abs(step(at)) : std::max(step(at), 0.0);
  double most = seen + deviations * std::sqrt(covariance(at, at));
  if (part == Part::lead_inductance) {
    most = std::min(most, most_inductance_H(fit.circuit));
  }
  const Eigen::VectorXd off = -covariance.col(at) / covariance(at, at);
  return {part, most, {off(0), off(first_mode), off(first_mode + 1), off(first_mode + 2)}};
}

/// Another circuit that may be the right one.
struct Other {
  CircuitFit fit;
  double penalty;  ///< over that of the fit, in −2 ln likelihood
  bool is_rival;   ///< of a lead, delay or rotation that is seen
};

std::vector<Other> others_of(const Sweep& sweep, const CircuitFit& fit) {
  const auto schwarz_penalty = [&](const CircuitFit& other) {
    return schwarz(other) - other.deviance - (schwarz(fit) - fit.deviance);
  };
  constexpr double per_element = 2.0 / 3.0;
  std::vector<Other> others;
  for (CircuitFit& each : larger_fits(sweep, fit)) {
    const std::vector<Mode>& modes = each.circuit.modes;
    const bool is_mode = each.parts.modes > fit.parts.modes;
    const bool is_first_kept = !is_in(sweep, modes.back()) ||
                               modes.back().conductance_S < 0.5 * modes.front().conductance_S;
    if (is_mode ? is_first_kept : each.parts.has(Part::lean) && !fit.parts.has(Part::lean)) {
      const double penalty = (is_mode ? per_element : 1.0) * schwarz_penalty(each);
      others.push_back({std::move(each), penalty, false});
    }
  }
  if (!sweep.has_phase) {
    return others;
  }
  if (!sees_turned_phase(fit)) {
    constexpr double doubt = 1.0;
    if (std::optional<CircuitFit> lead = turned_fit(sweep, fit, {Part::lead_resistance})) {
      others.push_back({*std::move(lead), doubt, false});
    }
    return others;
  }
  for (CircuitFit& each : turned_fits(sweep, fit)) {
    const double penalty = per_element * schwarz_penalty(each);
    others.push_back({std::move(each), penalty, true});
  }
  return others;
}

/// Averages the covariance over what the others have too. @return their weights
std::vector<double> average(const std::vector<Other>& others, CircuitFit& fit) {
  std::vector<double> weights;
  double sum = 1.0;
  for (const Other& each : others) {
    constexpr double most = 50.0;
    const double log_odds = 0.5 * (fit.deviance - each.fit.deviance - each.penalty);
    weights.push_back(std::exp(std::min(log_odds, most)));
    sum += weights.back();
  }
  const Eigen::MatrixXd own = fit.covariance;
  const Eigen::VectorXd fitted = (own.diagonal().array() > 0.0).cast<double>();
  for (std::size_t k = 0; k < others.size(); ++k) {
    weights[k] /= sum;
    const Eigen::MatrixXd& other = others[k].fit.covariance;
    const Eigen::Index n = std::min(own.rows(), other.rows());
    const Eigen::VectorXd step = fitted.head(n).cwiseProduct(
        to_vector(others[k].fit.circuit).head(n) - to_vector(fit.circuit).head(n));
    fit.covariance.topLeftCorner(n, n) +=
        weights[k] *
        (fitted.head(n).asDiagonal() * other.topLeftCorner(n, n) * fitted.head(n).asDiagonal() +
         step * step.transpose() - own.topLeftCorner(n, n));
  }
  return weights;
}

/// The circuits that a mixture is of, where there are rivals: those of some weight and, last, the fit, which
/// allows for the others that are no rivals.
std::vector<Alternative> alternatives_of(CircuitFit fit, const std::vector<Other>& others,
                                         const std::vector<double>& weights) {
  std::vector<Alternative> all;
  std::vector<Other> beside;
  double left = 1.0;
  for (std::size_t i = 0; i < others.size(); ++i) {
    constexpr double least = 1e-3;
    if (!others[i].is_rival) {
      beside.push_back(others[i]);
      continue;
    }
    left -= weights[i];
    if (weights[i] > least) {
      all.push_back({others[i].fit.circuit, others[i].fit.covariance, weights[i]});
    }
  }
  if (all.empty() || fit.description.fails()) {
    return {};
  }
  average(beside, fit);
  all.push_back({std::move(fit.circuit), std::move(fit.covariance), left});
  return all;
}

void allow_for_misfit(CircuitFit& fit) {
  if (!fit.description.fails()) {
    return;
  }
  Eigen::MatrixXd jacobian = fit.at.jacobian;
  Eigen::VectorXd residuals = fit.at.residuals;
  whiten(sizes(fit.noise), fit.at, jacobian);
  whiten(sizes(fit.noise), fit.at, residuals);
  const double along_each = std::pow(fit.description.misfit() / fit.description.residual, 2) *
                            residuals.squaredNorm() / static_cast<double>(fit.parts.size());
  fit.covariance += over_vector(along_each * inverse_normal_matrix(jacobian), fit.parts);
}

}  // namespace

bool sees(const CircuitFit& fit, Part part) {
  constexpr double many = 3.3;  // one sweep of 1000 has more by chance
  const Eigen::Index at = index_of(part);
  return fit.parts.has(part) &&
         std::abs(to_vector(fit.circuit)(at)) > many * std::sqrt(fit.covariance(at, at));
}

bool sees_turned_phase(const CircuitFit& fit) {
  return fit.parts.has_lead_or_delay() || sees(fit, Part::rotation);
}

void allow_for_what_is_not_certain(Selection& selected) {
  const Sweep& sweep = selected.sweep;
  CircuitFit& fit = selected.fit;
  for (const Part each : {Part::lead_resistance, Part::lead_inductance, Part::lean}) {
    if (!fit.parts.has(each) && (sweep.has_phase || each == Part::lean)) {
      selected.unseen.push_back(unseen_part(sweep, fit, each));
    }
  }
  std::vector<Other> others = others_of(sweep, fit);
  fit.covariance = over_vector(average_over_noise(fit.at, fit.noise), fit.parts);
  const CircuitFit alone = fit;
  const std::vector<double> weights = average(others, fit);
  fit.alternatives = alternatives_of(alone, others, weights);
  for (std::size_t i = 0; i < others.size(); ++i) {
    if (others[i].is_rival) {
      selected.rivals.push_back({std::move(others[i].fit), weights[i]});
    }
  }
  allow_for_misfit(fit);
}

}  // namespace sonoglide::identify::impedance
