/// Synthetic readings of known laws, with noise and misfit.
#pragma once

#include <string>
#include <vector>

#include "host_sim/studies/identify/friction/comparison.hpp"

namespace sonoglide::identify::friction::synthetic {

/// A kind of data sets.
struct Kind {
  std::string name;
  std::string law;
  bool are_forces;
  double misfit_probability;  ///< of a set to have a misfit at all
};

const std::vector<Kind>& kinds();

/// Whether the 95 % interval of each parameter has the truth, of a data set by its number: 24
/// velocity ratios, true parameters drawn from a range, noise of 0.01 of the friction limit, and a
/// misfit, a smooth random function of 1 to 10 times the noise.
std::vector<bool> covered(const Kind& kind, unsigned set);

}  // namespace sonoglide::identify::friction::synthetic
