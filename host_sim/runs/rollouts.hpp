/// Many scenes or many courses of a target at once, for whoever searches among them.
#pragma once

#include <cstddef>
#include <vector>

#include "host_sim/configure/experiment.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::runs {

/// What one of them is made of; all that it refers to outlives the call.
struct Rollout {
  const configure::Experiment& experiment;
  /// One for each whole carrier period, in [0, 1], in force from its sample on; 0: as before, and
  /// until the first other one the scene's steps. Null: the scene's steps.
  const double* targets;
  double* friction_ratios;  ///< takes one for each whole carrier period
};

/// Whole carrier periods of a scene.
/// @throws configure::ConfigurationError  it has no drive, or its carrier period changes
std::size_t whole_periods(const scene::Scene& scene);

/// Fills in the friction ratios. Those of scenes with their own targets are as `run` has them; where
/// the scene's tolerance is 1e-6 or more, and lanes can run it, they are as run_closed_loops
/// has them. A rollout depends on its scene and targets alone, to the bit, whatever the number of
/// threads.
/// @throws configure::ConfigurationError  as whole_periods(), and targets for a scene in open loop
/// @throws std::invalid_argument  a target is out of range; nothing was computed then
/// @throws loop::ComputationError  says which rollout, counted from 0
void run_rollouts(const std::vector<Rollout>& rollouts);

}  // namespace sonoglide::runs
