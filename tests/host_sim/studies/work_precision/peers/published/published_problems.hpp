/// The open-loop cases whose outcome is known to more than 20 digits.
#pragma once

#include <string>
#include <vector>

#include "host_sim/studies/work_precision/peers/contender.hpp"

namespace sonoglide::peers {

/// Their names, as the first column of the table of outcomes has them.
std::vector<std::string> published_names();

/// Table 1 at 384 N from rest, 100 carrier periods, changed as the name says.
Problem published_problem(const std::string& name);

struct PublishedOutcome {
  long double displacement;    ///< y at the end
  long double velocity;        ///< y' at the end
  long double friction;        ///< phi at the end
  long double friction_ratio;  ///< over the whole run
};

/// @throws csv::CsvError  no such name
PublishedOutcome published_outcome(const std::string& name);

}  // namespace sonoglide::peers
