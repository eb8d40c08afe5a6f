/// Which solvers are compared, and at which settings.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "firmware/plant/outcome.hpp"
#include "host_sim/studies/work_precision/peers/contender.hpp"

namespace sonoglide::work_precision {

/// 10^-first … 10^-last, two for each decade.
std::vector<double> tolerances(int first, int last);

/// Steps for each carrier period, four for each decade.
std::vector<double> step_counts(int first_decade, int last_decade);

/// The product's own in double are told apart by their palettes.
enum class Family {
  blue,
  orange,
  green,
  single,        ///< the product's solvers in float32
  paper,         ///< the paper's own method
  outside_peer,  ///< solvers of other libraries
};

/// What a setting is.
enum class Knob { tolerance, steps_per_period };

struct ComparedSolver {
  std::string name;
  Family family;
  Knob knob;
  std::vector<double> settings;  ///< from coarse to fine
  std::unique_ptr<peers::Contender> (*make)(const peers::Problem& problem, double setting);
};

/// Every solver that is built in.
const std::vector<ComparedSolver>& solvers();

/// What a failed advance shows as its status.
std::string status_of(plant::Error error);

/// A setting in words: "tolerance 1e-08", "1000 steps per period".
std::string setting_text(Knob knob, double setting);

/// One for each order in which a solver takes part, in double or in float. Defined in composed.hpp.
/// Those of a solver have a translation unit of their own, which CMake makes of contenders.cpp.in:
/// they take long to compile.
template <class Described, class Scalar>
std::vector<ComparedSolver> contenders();

}  // namespace sonoglide::work_precision
