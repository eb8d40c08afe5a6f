/// Which solvers are compared, and at which settings.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host_sim/studies/work_precision/peers/contender.hpp"
#include "host_sim/studies/work_precision/peers/problem.hpp"

namespace sonoglide::work_precision {

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

struct Solver {
  std::string name;
  Family family;
  Knob knob;
  std::vector<double> settings;  ///< from coarse to fine
  std::unique_ptr<peers::Contender> (*make)(const peers::Problem& problem, double setting);
};

/// Every solver that is built in.
const std::vector<Solver>& solvers();

/// A setting in words: "tolerance 1e-08", "1000 steps per period".
std::string setting_text(Knob knob, double setting);

}  // namespace sonoglide::work_precision
