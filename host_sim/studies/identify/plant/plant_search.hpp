/// Where the plant of a unit is looked for.
#pragma once

#include <Eigen/Core>

#include <functional>
#include <vector>

#include "host_sim/studies/identify/least_squares.hpp"
#include "host_sim/studies/identify/plant/plant_problem.hpp"
#include "host_sim/studies/identify/plant/uncertainty.hpp"

namespace sonoglide::identify::plant {

/// The spring's range and the contact's are searched by the first periods of each stretch, in which a wrong natural
/// mode is not yet a turn off; then ever more of them count.
/// @param progress  is told the part done
LeastSquaresFit best_fit(const PlantProblem& problem, const Eigen::VectorXd& start,
                         const std::function<void(double)>& progress);

/// What the stretches swing by is plain in the readings: then no other mode turns as theirs does.
/// @param expected  deviation of a reading
bool swings_are_plain(const PlantProblem& problem, const LeastSquaresFit& fit, double expected);

struct PossibleSprings {
  std::vector<Eigen::VectorXd> parameters;
  bool is_cut = false;  ///< one at an end of the scan is among them
};

/// Springs about that of a fit, each with the other unknowns and what the stretches swing by as they are best with
/// it, but for a mode that rings on through every stretch.
class SpringScan {
 public:
  /// @param reach  to either side, of the logarithm of the spring
  SpringScan(const PlantProblem& problem, const LeastSquaresFit& fit, double reach);

  const Eigen::VectorXd& best() const;

  /// Those that the readings do not tell from the fit. The largest of so many sums of as many squares of noise as a
  /// mode has numbers is by more above the true one's than where a single mode is in question.
  PossibleSprings possible(const LeastSquaresFit& fit, const Deviations& deviations) const;

 private:
  static constexpr double step = 2.5e-4;
  struct Place {
    double sum_of_squares;
    Eigen::VectorXd parameters;
  };

  std::vector<Place> places_;
};

}  // namespace sonoglide::identify::plant
