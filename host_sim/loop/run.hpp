/// One simulated run of a scene, in open or closed loop.
#pragma once

#include <optional>

#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/experiment.hpp"
#include "host_sim/loop/control/control_port.hpp"
#include "host_sim/loop/plant/failure.hpp"
#include "host_sim/loop/run_result.hpp"
#include "host_sim/loop/watch.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// Designs and runs a scene, its plant as it is stated and its controller in this process, in memory
/// that does not grow with its duration. The result carries the controller's design.
/// @throws ComputationError  the solver failed
/// @throws configure::ConfigurationError  no controller can be designed for the scene
RunResult run(const scene::Scene& scene, const Watch& watch = {});

/// The same of an experiment that has been designed.
RunResult run(const configure::Experiment& experiment, const Watch& watch = {});

/// The same of a plant with a controller that has been designed for it or for one near it; none in
/// open loop.
RunResult run(const scene::Scene& plant, const std::optional<configure::ControlDesign>& design,
              const Watch& watch);

/// The same of a closed loop whose controller is elsewhere.
/// @param controller  as it is before its first step
/// @throws what the controller throws, besides
RunResult run(const scene::Scene& plant, const configure::ControlDesign& design,
              ControlPort& controller, const Watch& watch = {});

}  // namespace sonoglide::loop
