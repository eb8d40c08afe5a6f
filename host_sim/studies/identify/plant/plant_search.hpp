/// Where the plant of a unit is looked for.
#pragma once

#include <Eigen/Core>

#include <functional>
#include <vector>

#include "host_sim/studies/identify/least_squares.hpp"
#include "host_sim/studies/identify/plant/plant_problem.hpp"

namespace sonoglide::identify::plant {

/// The spring's range and the contact's are searched by the first periods of each stretch, in which a wrong natural
/// mode is not yet a turn off; then ever more of them count.
/// @param progress  is told the part done
LeastSquaresFit best_fit(const PlantProblem& problem, const Eigen::VectorXd& start,
                         const std::function<void(double)>& progress);

/// A fit with one more unknown is better by more than noise makes the best of the springs that best_fit() tries: an
/// F-test of the unknown at so many springs.
/// @param expected  deviation of a reading
bool explains_more(const LeastSquaresFit& fuller, const LeastSquaresFit& fit, double expected);

/// What the stretches swing by is plain in the readings: then no other mode turns as theirs does.
/// @param expected  deviation of a reading
bool swings_are_plain(const PlantProblem& problem, const LeastSquaresFit& fit, double expected);

/// With the other parameters as they are best with each.
struct PossibleSprings {
  std::vector<Eigen::VectorXd> parameters;
  Eigen::VectorXd nearest{};  ///< to the scene's
  double least = 0.0;         ///< over the scene's
  double most = 0.0;          ///< likewise
  bool is_cut = false;        ///< one at an end of the scan is among them
};

/// Springs about that of the scene, each with the other unknowns and what the stretches swing by as they are best
/// with it. Where noise hides the mode, many of them fit as well, with swings that are fitted to the noise.
class SpringScan {
 public:
  static constexpr double reach = 0.48;  ///< to either side, of the logarithm of the spring

  /// @param start     of each but for the spring
  /// @param expected  deviation of a reading
  SpringScan(const PlantProblem& problem, const Eigen::VectorXd& start, double expected,
             const std::function<void(double)>& progress);

  const Eigen::VectorXd& best() const;

  /// The fit's, and those that the readings do not tell from it.
  PossibleSprings possible(const LeastSquaresFit& fit) const;

 private:
  struct Place {
    double sum_of_squares = 0.0;
    Eigen::VectorXd parameters;
  };
  std::vector<LeastSquaresFit> coarse_fits(const PlantProblem& problem,
                                           const Eigen::VectorXd& start) const;
  void add_near(const PlantProblem& problem, const LeastSquaresFit& coarse);
  /// Sum of squares up to which one of so many springs is possible beside a fit.
  double highest_possible(const LeastSquaresFit& fit, std::size_t springs) const;

  double stated_;  ///< logarithm of the scene's spring
  double expected_;
  std::vector<Place> places_;
};

}  // namespace sonoglide::identify::plant
