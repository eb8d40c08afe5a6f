/// One friction law fitted to measured friction, and what the fit is worth.
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "host_sim/studies/identify/friction/candidate.hpp"
#include "host_sim/studies/identify/friction/readings.hpp"
#include "host_sim/studies/identify/identification.hpp"

namespace sonoglide::identify::friction {

struct LawFit {
  Candidate law;
  Eigen::VectorXd logs;  ///< of the parameters, as LawProblem has them
  /// With the values that follow from one of them by a factor. A value is not a number where the
  /// fit ends at the end of its range.
  std::vector<Estimate> parameters;
  std::vector<double> residuals;  ///< measured less fitted friction, of the readings' kind
  /// Both over the friction limit: as friction ratios.
  double residual_rms = 0.0;
  double misfit = 0.0;
  double akaike = 0.0;  ///< corrected_akaike(); infinite with too few readings
  /// Of so few runs of residuals of one sign, were they white; 1 within the law's accuracy.
  double runs_probability = 0.0;
  double autocorrelation = 0.0;  ///< of neighbouring residuals
  /// Of residuals so large, were the stated standard errors all; not a number without them.
  double chi_square_probability = 0.0;
  std::size_t different = 0;      ///< readings; see Readings::distinct()
  bool is_determined = true;      ///< as many different readings as parameters, at least
  std::vector<std::string> open;  ///< what of this law the data leave open, each a sentence

  Eigen::Index parameter_count() const { return logs.size(); }
  bool exceeds_standard_errors() const;
  /// Residuals that exceed the stated standard errors, or show a pattern.
  bool fails() const;
};

/// Probability below which a law fails.
inline constexpr double fails_below = 0.01;

/// Without intervals.
LawFit fit(const Readings& readings, const Candidate& law);

/// Fills the ends of the intervals, and what is open.
void add_intervals(const Readings& readings, LawFit& fit);

/// Friction that a fitted law gives for other velocities.
double friction_of(const Readings& readings, const LawFit& fit, const Reading& row);

/// Probability that white residuals have as few runs of one sign as these or fewer, given how many
/// are of each sign (Wald and Wolfowitz 1940, exactly for up to 1000 residuals).
double runs_probability(const std::vector<double>& residuals);

}  // namespace sonoglide::identify::friction
