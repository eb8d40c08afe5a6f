#include "host_sim/studies/identify/impedance/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "host_sim/studies/identify/impedance/description.hpp"
#include "host_sim/studies/identify/impedance/plausible.hpp"

namespace sonoglide::identify::impedance {
namespace {

/// What a part that is not fitted may be, by its linearisation; a resistance of leads in place of a
/// rotation that is not seen.
Unseen unseen_part(const Sweep& sweep, const CircuitFit& fit, Part part) {
  Parts larger = fit.parts.with(part);
  Circuit circuit = fit.circuit;
  if (part == Part::lead_resistance && !sees_rotation(fit)) {
    larger = larger.with(Part::rotation, false);
    circuit.rotation_rad = 0.0;
  }
  const Solution solution = solve(linearise(sweep, larger, circuit), fit.noise);
  const Eigen::Index at = larger.index(part);
  constexpr double deviations = 2.0;
  const double step = part == Part::lean ? std::abs(solution.step(at)) : solution.step(at);
  double most = std::max(step, 0.0) + deviations * std::sqrt(solution.covariance(at, at));
  if (part == Part::lead_inductance) {
    most = std::min(most, most_inductance_H(fit.circuit));
  }
  const Eigen::VectorXd off = -solution.covariance.col(at) / solution.covariance(at, at);
  Unseen unseen{part, most, {}};
  unseen.off << off(0), off.segment<3>(larger.first_mode());
  return unseen;
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
  for (Eigen::Index i = 0; i < 3 * static_cast<Eigen::Index>(fit.parts.modes); ++i) {
    places.push_back(i < 3 * other.parts.modes ? other.parts.first_mode() + i : -1);
  }
  return places;
}

struct Other {
  CircuitFit fit;
  double penalty;  ///< over that of the fit, in −2 ln likelihood
};

/// Averages the covariance. @return the weights of the others
std::vector<double> allow_for(const std::vector<Other>& others, CircuitFit& fit) {
  std::vector<double> weights;
  double sum = 1.0;
  for (const Other& each : others) {
    constexpr double most = 50.0;
    const double log_odds = 0.5 * (fit.deviance - each.fit.deviance - each.penalty);
    weights.push_back(each.fit.covariance.allFinite() ? std::exp(std::min(log_odds, most)) : 0.0);
    sum += weights.back();
  }
  const Eigen::MatrixXd own = fit.covariance;
  for (std::size_t k = 0; k < others.size(); ++k) {
    weights[k] /= sum;
    const CircuitFit& other = others[k].fit;
    const std::vector<Eigen::Index> places = places_in(other, fit);
    for (Eigen::Index i = 0; i < own.rows(); ++i) {
      for (Eigen::Index j = 0; j < own.cols(); ++j) {
        const Eigen::Index a = places[static_cast<std::size_t>(i)];
        const Eigen::Index b = places[static_cast<std::size_t>(j)];
        if (a >= 0 && b >= 0) {
          const double square =
              other.covariance(a, b) + (other.p(a) - fit.p(i)) * (other.p(b) - fit.p(j));
          fit.covariance(i, j) += weights[k] * (square - own(i, j));
        }
      }
    }
  }
  return weights;
}

/// Further modes, and a resistance of the leads, of which too little is seen.
std::vector<Other> unseen_circuits(const Sweep& sweep, const CircuitFit& fit) {
  const double readings = std::log(static_cast<double>(fit.at.residuals.size()));
  std::vector<Other> others;
  for (const Place place : {Place::inside, Place::beside}) {
    if (std::optional<CircuitFit> larger = with_another_mode(sweep, fit, place)) {
      const std::vector<Mode>& modes = larger->circuit.modes;
      if (place == Place::beside ||
          modes.back().conductance_S < 0.5 * modes.front().conductance_S) {
        others.push_back({*std::move(larger), 3.0 * readings});
      }
    }
  }
  if (sweep.has_phase && !sees_lead_or_rotation(fit)) {
    // In place of the rotation, which it looks like.
    Circuit start = fit.circuit;
    start.rotation_rad = 0.0;
    CircuitFit other = fit_circuit(
        sweep, fit.parts.with(Part::rotation, false).with(Part::lead_resistance), start, fit.noise);
    if (is_plausible(sweep, other)) {
      constexpr double doubt = 1.0;
      others.push_back({std::move(other), doubt});
    }
  }
  return others;
}

}  // namespace

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

bool sees_rotation(const CircuitFit& fit) {
  constexpr double many = 3.3;  // one sweep of 1000 has more by chance
  const Eigen::Index at = fit.parts.index(Part::rotation);
  return fit.parts.has(Part::rotation) &&
         std::abs(fit.p(at)) > many * std::sqrt(fit.covariance(at, at));
}

bool sees_lead_or_rotation(const CircuitFit& fit) {
  return fit.parts.has(Part::lead_resistance) || fit.parts.has(Part::lead_inductance) ||
         sees_rotation(fit);
}

void allow_for_what_is_not_certain(const Sweep& sweep, Selection& selected) {
  CircuitFit& fit = selected.fit;
  for (const Part each : {Part::lead_resistance, Part::lead_inductance, Part::lean}) {
    if (!fit.parts.has(each) && (sweep.has_phase || each == Part::lean)) {
      selected.unseen.push_back(unseen_part(sweep, fit, each));
    }
  }
  std::vector<Other> others = unseen_circuits(sweep, fit);
  const std::size_t unseen = others.size();
  if (sees_lead_or_rotation(fit)) {
    for (CircuitFit& each : rivals_of_phase(sweep, fit)) {
      const double penalty = schwarz(each) - each.deviance - (schwarz(fit) - fit.deviance);
      others.push_back({std::move(each), penalty});
    }
  }
  fit.covariance = allow_for_noise(fit.at, fit.noise);
  const std::vector<double> weights = allow_for(others, fit);
  for (std::size_t i = unseen; i < others.size(); ++i) {
    selected.rivals.push_back({std::move(others[i].fit), weights[i]});
  }
  allow_for_misfit(fit);
}

}  // namespace sonoglide::identify::impedance
