#include "host_sim/studies/identify/plant/plant_search.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "host_sim/studies/identify/plant/uncertainty.hpp"

namespace sonoglide::identify::plant {
namespace {

constexpr std::array<std::size_t, 4> windows = {16, 64, 256, PlantProblem::all_steps};

/// Of a residual, times what correlation takes from the number of independent residuals.
double variance(const Eigen::VectorXd& residuals, double expected) {
  const double seen = residuals.squaredNorm() / static_cast<double>(residuals.size());
  return std::max(seen, expected * expected) * correlation_factor(residuals);
}

/// What the best of many wrong springs, each with swings of its own, may be better by than the true one, in
/// variances of a residual: the bound of the largest of so many sums of squares of noise.
/// Source: Laurent and Massart, The Annals of Statistics 28 (2000), lemma 1.
double margin(std::size_t springs, Eigen::Index numbers) {
  constexpr double of_one_spring = 3.84;  // 95 % of the squares of a single number
  const double many = std::log(static_cast<double>(springs));
  return of_one_spring + 2.0 * many + 2.0 * std::sqrt(static_cast<double>(numbers) * many);
}

/// Of those where a fit may begin.
constexpr int springs_to_a_side = 24;

/// Springs that are fitted, apart in their logarithm; between them what they are fitted by is taken from them.
constexpr double coarse_step = 0.02;

/// Of the mode at the end of a stretch, from one spring between them to the next [rad].
constexpr double fine_turn = 0.36;

constexpr auto is_better = [](const auto& a, const auto& b) {
  return a.sum_of_squares < b.sum_of_squares;
};

/// Where the fit may begin: springs and contacts over a grid, the best first.
std::vector<Eigen::VectorXd> starts(const PlantProblem& problem, const Eigen::VectorXd& start,
                                    std::size_t most) {
  constexpr double spring_step = 0.015;
  constexpr int contacts = 2;
  constexpr double contact_step = 0.45;
  const Eigen::Index contact = problem.index_of("friction.contact_stiffness_N_per_m");
  std::vector<std::pair<double, Eigen::VectorXd>> all;
  for (int i = -springs_to_a_side; i <= springs_to_a_side; ++i) {
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
    std::stable_sort(fits.begin(), fits.end(), is_better);
    std::transform(fits.begin(), fits.end(), places.begin(),
                   [](const LeastSquaresFit& fit) { return fit.parameters; });
    progress((1.0 + static_cast<double>(window)) / windows.size());
  }
  return problem.polished(fits.front());
}

bool explains_more(const LeastSquaresFit& fuller, const LeastSquaresFit& fit, double expected) {
  constexpr std::size_t springs = 2 * springs_to_a_side + 1;
  const double noise =
      margin(springs, fuller.parameters.size()) * variance(fuller.residuals, expected);
  return fit.sum_of_squares - fuller.sum_of_squares > noise;
}

bool swings_are_plain(const PlantProblem& problem, const LeastSquaresFit& fit, double expected) {
  constexpr double plainly = 100.0;
  const auto n = static_cast<double>(fit.residuals.size());
  Eigen::VectorXd calm = fit.parameters;
  calm.tail(calm.size() - static_cast<Eigen::Index>(problem.unknowns().size())).setZero();
  const double without = problem.residuals(calm, PlantProblem::all_steps).squaredNorm();
  return without - fit.sum_of_squares > plainly * variance(fit.residuals, expected) *
                                            static_cast<double>(calm.size()) * std::log(n);
}

SpringScan::SpringScan(const PlantProblem& problem, const Eigen::VectorXd& start, double expected,
                       const std::function<void(double)>& progress)
    : stated_(problem.start()(0)), expected_(expected) {
  const std::vector<LeastSquaresFit> coarse = coarse_fits(problem, start);
  progress(0.5);
  const LeastSquaresFit& best = *std::min_element(coarse.begin(), coarse.end(), is_better);
  const double most = highest_possible(best, coarse.size());
  const auto is_possible = [&](std::size_t i) {
    return i < coarse.size() && coarse[i].sum_of_squares <= most;
  };
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    if (is_possible(i - 1) || is_possible(i) || is_possible(i + 1)) {
      add_near(problem, coarse[i]);
    }
    progress(0.5 + 0.5 * static_cast<double>(i) / static_cast<double>(coarse.size()));
  }
}

std::vector<LeastSquaresFit> SpringScan::coarse_fits(const PlantProblem& problem,
                                                     const Eigen::VectorXd& start) const {
  const auto to_a_side = static_cast<std::size_t>(std::lround(reach / coarse_step));
  std::vector<LeastSquaresFit> fits(2 * to_a_side + 1);
  tbb::parallel_for(std::size_t{0}, fits.size(), [&](std::size_t i) {
    Eigen::VectorXd place = start;
    place(0) = stated_ + coarse_step * (static_cast<double>(i) - static_cast<double>(to_a_side));
    fits[i] = problem.polished(problem.at(place), 1);
  });
  return fits;
}

/// The slopes of the fit serve for the springs near it, but for their modes' speed.
void SpringScan::add_near(const PlantProblem& problem, const LeastSquaresFit& coarse) {
  const auto springs = static_cast<std::size_t>(
      std::ceil(0.5 * coarse_step * problem.longest_turn(coarse.parameters) / fine_turn));
  const Eigen::MatrixXd slopes = problem.slopes(coarse);
  const std::size_t first = places_.size();
  places_.resize(first + springs);
  tbb::parallel_for(std::size_t{0}, springs, [&](std::size_t i) {
    const double moved =
        coarse_step * ((static_cast<double>(i) + 0.5) / static_cast<double>(springs) - 0.5);
    Eigen::VectorXd place = coarse.parameters;
    place(0) += moved;
    const Eigen::VectorXd residuals = problem.residuals(place, PlantProblem::all_steps);
    const Eigen::MatrixXd others =
        problem.turned(slopes, coarse.parameters, moved).rightCols(place.size() - 1);
    Eigen::VectorXd step = Eigen::VectorXd::Zero(place.size());
    step.tail(others.cols()) = -others.colPivHouseholderQr().solve(residuals);
    places_[first + i] = {(residuals + others * step.tail(others.cols())).squaredNorm(),
                          problem.moved(place, step)};
  });
}

const Eigen::VectorXd& SpringScan::best() const {
  return std::min_element(places_.begin(), places_.end(), is_better)->parameters;
}

double SpringScan::highest_possible(const LeastSquaresFit& fit, std::size_t springs) const {
  return fit.sum_of_squares +
         margin(springs, fit.parameters.size()) * variance(fit.residuals, expected_);
}

PossibleSprings SpringScan::possible(const LeastSquaresFit& fit) const {
  const double most = highest_possible(fit, places_.size());
  PossibleSprings springs{{fit.parameters}};
  for (const Place& place : places_) {
    if (place.sum_of_squares <= most) {
      springs.parameters.push_back(place.parameters);
    }
  }
  const auto [least, largest] = std::minmax_element(
      springs.parameters.begin(), springs.parameters.end(),
      [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) { return a(0) < b(0); });
  springs.least = std::exp((*least)(0) - stated_);
  springs.most = std::exp((*largest)(0) - stated_);
  springs.nearest = *std::min_element(springs.parameters.begin(), springs.parameters.end(),
                                      [&](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
                                        return std::abs(a(0) - stated_) < std::abs(b(0) - stated_);
                                      });
  springs.is_cut = std::max(std::log(springs.most), -std::log(springs.least)) > reach - coarse_step;
  return springs;
}

}  // namespace sonoglide::identify::plant
