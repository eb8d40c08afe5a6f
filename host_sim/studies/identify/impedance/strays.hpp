/// Readings that are errors of a single reading.
#pragma once

#include <cstddef>
#include <vector>

#include "host_sim/studies/identify/impedance/circuit_fit.hpp"

namespace sonoglide::identify::impedance {

/// Readings whose residual, in magnitude or phase, is 8 robust standard deviations off the median of the
/// three readings on either side, while the two next to it are within 4: a run of readings that are off
/// is a mode. The standard deviation is that from reading to reading, of the 31 or the 101 readings
/// around, whichever is larger.
std::vector<std::size_t> find_strays(const CircuitFit& fit);

}  // namespace sonoglide::identify::impedance
