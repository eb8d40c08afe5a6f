/// Sweeps with more readings than a fit has use for.
#pragma once

#include <cstddef>

#include "host_sim/studies/identify/impedance/selection.hpp"
#include "host_sim/studies/identify/impedance/sweep.hpp"

namespace sonoglide::identify::impedance {

/// Of a longer sweep one of so many readings is used, and all about the resonance.
inline constexpr std::size_t most_readings = 6000;

/// select_circuit; of a longer sweep first with all readings about its largest conductance, then
/// with all about the resonance that this leads to. A warning says so.
/// @throws loop::ComputationError  see select_circuit
Selection select_of_any_length(const Sweep& sweep);

}  // namespace sonoglide::identify::impedance
