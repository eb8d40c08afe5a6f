/// Every friction law against the same measured friction.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "host_sim/output/page.hpp"
#include "host_sim/output/study_report.hpp"
#include "host_sim/studies/identify/friction/candidate.hpp"
#include "host_sim/studies/identify/friction/law_problem.hpp"
#include "host_sim/studies/identify/friction/readings.hpp"
#include "host_sim/studies/identify/identification.hpp"

namespace sonoglide::identify::friction {

// One friction law fitted to measured friction, and what the fit is worth.

// 95 % intervals of the parameters of a law.

/// What the data do not tell.
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Of the logarithm; unknown where the data leave that side open, as far as the range goes.
struct LogInterval {
  double low = unknown;
  double high = unknown;
};

/// Profile likelihood: at a value x of one parameter the others are fitted again, and
///   t(x) = ± sqrt((S(x) - S_min)/s²),  s² = S_min/(n - p), at least that of the stated errors and
/// of the last digit of the values,
/// is taken for Student's t with n - p degrees of freedom. So no interval rests on the law being
/// linear, and a parameter that the data do not bound has an open end. What counts is the mean of
/// the distribution functions over the scatters, each by its probability, so that misfit widens the
/// interval as far as the residuals show it.
///
/// @param best           parameters, the best for white scatter
/// @param probabilities  of the scatters
/// @return one for each parameter; open on both sides where there are no more readings than
///         parameters, or fewer different ones
std::vector<LogInterval> intervals(const LawProblem& problem, const Eigen::VectorXd& best,
                                   const std::vector<Scatter>& scatters,
                                   const std::vector<double>& probabilities);

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

/// Values and ends of the intervals as they are shown.
std::vector<Estimate> estimates(const LawFit& fit, const Readings& readings,
                                const LawProblem& problem,
                                const std::vector<LogInterval>& intervals);

/// Of the scatters under a fit.
std::vector<double> probabilities_of(const LawProblem& problem, const LawFit& fit,
                                     const std::vector<Scatter>& scatters);

/// Fills the ends of the intervals, and what is open.
void add_intervals(const Readings& readings, LawFit& fit);

/// Friction that a fitted law gives for other velocities.
double friction_of(const Readings& readings, const LawFit& fit, const Reading& row);

/// Probability that white residuals have as few runs of one sign as these or fewer, given how many
/// are of each sign (Wald and Wolfowitz 1940, exactly for up to 1000 residuals).
double runs_probability(const std::vector<double>& residuals);

/// Laws whose corrected Akaike criteria differ by less are not told apart: a likelihood ratio of 20.
inline constexpr double told_apart_from = 6.0;

struct Comparison {
  Readings readings;
  std::vector<LawFit> laws;  ///< the best first; without a criterion by residuals
  std::vector<std::string> warnings;
  std::vector<std::string> cannot_tell;
  std::string scene;  ///< of the best law; empty: run would refuse it, and a warning says why

  const LawFit& best() const { return laws.front(); }
  /// Difference of the criterion to that of the best; not a number where there is none.
  double difference(const LawFit& law) const { return law.akaike - best().akaike; }
  /// Not told apart from the best, and does not exceed the stated standard errors, unless it is the
  /// best itself.
  bool is_possible(const LawFit& law) const {
    return &law == &best() ||
           !(law.exceeds_standard_errors() || difference(law) >= told_apart_from);
  }
};

/// Fits the laws and compares them. Laws that are not possible get no intervals.
///
/// @param laws      words of scenes; empty: all of them
/// @param progress  is told the part done
Comparison compare(Readings readings, const std::vector<std::string>& laws,
                   const std::function<void(double)>& progress);

// The files and the printed page that an identification of friction leaves behind.

/// identify.json: what every identification tells, of the best law, and `law` and `laws[]`.
nlohmann::ordered_json to_json(const Comparison& comparison);

/// @param name  of the file of readings
output::Page page(const Comparison& comparison, const std::string& name);

/// An open-loop scene of the best law at the middle one of the readings with vibration, whose
/// friction ratio is that of the fit. What no reading tells is assumed, and said so in comments: a
/// mass that friction hardly moves, a spring far below resonance, the friction coefficient, and the
/// friction limit or the carrier where the file does not have them.
std::string scene_text(const Comparison& comparison);

/// report.html, identify.json and, where there is one, scene.toml.
output::StudyReport report(const Comparison& comparison, const std::string& name);

/// What is wrong with the best that there is: empty, or why a law fails.
std::string verdict(const Comparison& comparison, const LawFit& fit);

}  // namespace sonoglide::identify::friction
