/// From a scene to the motion that is compared.
#pragma once

#include "host_sim/scene/scene.hpp"
#include "host_sim/studies/work_precision/peers/contender.hpp"

namespace sonoglide::work_precision {

/// Longer runs add nothing to a comparison but time.
inline constexpr int most_periods = 1000;

/// A comparison needs an open loop, a carrier, a Dahl contact with friction, a constant sliding
/// velocity and a whole number of carrier periods; [solver] and the recording play no part.
/// @throws configure::ConfigurationError  names the key that stands in the way
peers::Problem problem_of(const scene::Scene& scene);

}  // namespace sonoglide::work_precision
