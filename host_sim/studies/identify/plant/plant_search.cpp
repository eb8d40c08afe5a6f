#include "host_sim/studies/identify/plant/plant_search.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace sonoglide::identify::plant {
namespace {

constexpr std::array<std::size_t, 4> windows = {16, 64, 256, PlantProblem::all_steps};

/// Where the fit may begin: springs and contacts over a grid, the best first.
std::vector<Eigen::VectorXd> starts(const PlantProblem& problem, const Eigen::VectorXd& start,
                                    std::size_t most) {
  constexpr int springs = 24;  // to either side
  constexpr double spring_step = 0.015;
  constexpr int contacts = 2;
  constexpr double contact_step = 0.45;
  const Eigen::Index contact = problem.index_of("friction.contact_stiffness_N_per_m");
  std::vector<std::pair<double, Eigen::VectorXd>> all;
  for (int i = -springs; i <= springs; ++i) {
    for (int k = -contacts; k <= contacts; ++k) {
      Eigen::VectorXd place = start;
      place(0) += spring_step * i;
      if (contact >= 0) {
        place(contact) += contact_step * k;
      } else if (k != 0) {
        continue;
      }
      all.emplace_back(0.0, place);
    }
  }
  const auto unknowns = static_cast<Eigen::Index>(problem.unknowns().size());
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) {
    all[i].second = problem.adjusted(std::move(all[i].second), unknowns, windows.front());
    all[i].first = problem.residuals(all[i].second, windows.front()).squaredNorm();
  });
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Eigen::VectorXd> best;
  for (std::size_t i = 0; i < std::min(most, all.size()); ++i) {
    best.push_back(all[i].second);
  }
  return best;
}

}  // namespace

LeastSquaresFit best_fit(const PlantProblem& problem, const Eigen::VectorXd& start,
                         const std::function<void(double)>& progress) {
  std::array<std::size_t, windows.size()> kept = {8, 4, 2, 1};
  std::vector<Eigen::VectorXd> places = starts(problem, start, kept.front());
  std::vector<LeastSquaresFit> fits;
  for (std::size_t window = 0; window < windows.size(); ++window) {
    fits.clear();
    places.resize(std::min(places.size(), kept[window]));
    for (const Eigen::VectorXd& place : places) {
      fits.push_back(problem.fit(place, windows[window]));
    }
    std::stable_sort(fits.begin(), fits.end(), [](const auto& a, const auto& b) {
      return a.sum_of_squares < b.sum_of_squares;
    });
    std::transform(fits.begin(), fits.end(), places.begin(),
                   [](const LeastSquaresFit& fit) { return fit.parameters; });
    progress((1.0 + static_cast<double>(window)) / windows.size());
  }
  return problem.polished(fits.front());
}

bool swings_are_plain(const PlantProblem& problem, const LeastSquaresFit& fit, double expected) {
  constexpr double plainly = 100.0;
  const auto n = static_cast<double>(fit.residuals.size());
  const double variance =
      std::max(fit.sum_of_squares / n, expected * expected) * correlation_factor(fit.residuals);
  Eigen::VectorXd calm = fit.parameters;
  calm.tail(calm.size() - static_cast<Eigen::Index>(problem.unknowns().size())).setZero();
  const double without = problem.residuals(calm, PlantProblem::all_steps).squaredNorm();
  return without - fit.sum_of_squares >
         plainly * variance * static_cast<double>(calm.size()) * std::log(n);
}

SpringScan::SpringScan(const PlantProblem& problem, const LeastSquaresFit& fit, double reach)
    : places_(2 * static_cast<std::size_t>(std::lround(reach / step)) + 1, {0.0, fit.parameters}) {
  const std::size_t to_a_side = places_.size() / 2;
  const auto damping = problem.index_of(damping_key);
  tbb::parallel_for(std::size_t{0}, places_.size(), [&](std::size_t i) {
    Place& place = places_[i];
    place.parameters(0) += step * (static_cast<double>(i) - static_cast<double>(to_a_side));
    place.parameters(damping) =
        std::log(problem.unknowns()[static_cast<std::size_t>(damping)].unit);
    place.parameters = problem.adjusted(place.parameters, 1, PlantProblem::all_steps);
    place.sum_of_squares =
        problem.residuals(place.parameters, PlantProblem::all_steps).squaredNorm();
  });
}

const Eigen::VectorXd& SpringScan::best() const {
  return std::min_element(
             places_.begin(), places_.end(),
             [](const Place& a, const Place& b) { return a.sum_of_squares < b.sum_of_squares; })
      ->parameters;
}

PossibleSprings SpringScan::possible(const LeastSquaresFit& fit,
                                     const Deviations& deviations) const {
  const double modes = std::log(static_cast<double>(places_.size()));
  const auto numbers = static_cast<double>(fit.parameters.size());
  const double above =
      std::pow(deviations.student, 2) + 2.0 * modes + 2.0 * std::sqrt(numbers * modes);
  PossibleSprings springs;
  for (const Place& place : places_) {
    if (place.sum_of_squares <= fit.sum_of_squares + above * deviations.variance) {
      springs.parameters.push_back(place.parameters);
      springs.is_cut |= &place == &places_.front() || &place == &places_.back();
    }
  }
  return springs;
}

}  // namespace sonoglide::identify::plant
