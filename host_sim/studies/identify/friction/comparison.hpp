/// Every friction law against the same measured friction.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host_sim/studies/identify/friction/law_fit.hpp"

namespace sonoglide::identify::friction {

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

}  // namespace sonoglide::identify::friction
