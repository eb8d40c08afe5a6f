/// How much better than a smaller circuit a larger one describes a sweep.
#pragma once

#include "host_sim/studies/identify/impedance/circuit_fit.hpp"

namespace sonoglide::identify::impedance {

/// How likely chance alone lowers the deviance as much: the F test on the whitened residuals.
/// @param smaller  a fit of fewer parameters to the same sweep
double chance(const CircuitFit& smaller, const CircuitFit& larger);

}  // namespace sonoglide::identify::impedance
