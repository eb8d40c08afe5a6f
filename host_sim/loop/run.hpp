/// One simulated run of a scene, in open or closed loop.
#pragma once

#include <functional>

#include "host_sim/loop/computation_error.hpp"
#include "host_sim/loop/run_result.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// Called now and then with the fraction done, in [0, 1].
using Progress = std::function<void(double fraction)>;

/// Runs a scene.
/// @throws ComputationError  the solver failed
/// @throws scene::ConfigurationError  no controller can be designed for the scene; a scene that was
///         read from a file has been checked for that
RunResult run(const scene::Scene& scene, const Progress& progress);

}  // namespace sonoglide::loop
