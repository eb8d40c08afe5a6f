/// One simulated run of a scene, in open or closed loop.
#pragma once

#include <optional>

#include "host_sim/configure/control_design.hpp"
#include "host_sim/loop/control_port.hpp"
#include "host_sim/loop/failure.hpp"
#include "host_sim/loop/run_result.hpp"
#include "host_sim/loop/watch.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// Runs a scene, its controller in this process, in memory that does not grow with its duration.
/// The result carries the controller's design.
/// @throws ComputationError  the solver failed
/// @throws configure::ConfigurationError  no controller can be designed for the scene; a scene that
///         was read from a file has been checked for that
RunResult run(const scene::Scene& scene, const Watch& watch = {});

/// The same with the controller that has been designed for the scene; none in open loop.
RunResult run(const scene::Scene& scene, const std::optional<configure::ControlDesign>& design,
              const Watch& watch);

/// The same for a closed-loop scene whose controller is elsewhere.
/// @param controller  as it is before its first step
/// @throws what the controller throws, besides
RunResult run(const scene::Scene& scene, ControlPort& controller, const Watch& watch = {});
RunResult run(const scene::Scene& scene, const configure::ControlDesign& design,
              ControlPort& controller, const Watch& watch);

}  // namespace sonoglide::loop
