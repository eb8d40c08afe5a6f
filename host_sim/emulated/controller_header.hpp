/// The controller of a scene as C++, to be compiled into an image.
#pragma once

#include <optional>
#include <string>

#include "host_sim/configure/control_design.hpp"
#include "host_sim/emulated/board_list.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::emulated {

/// @throws configure::ConfigurationError  a float64 scene on a board that computes that in software
void require_arithmetic(const scene::Scene& scene, const emulated::EmulatedBoard& board);

/// The name under which an image includes it.
inline constexpr const char* controller_header_name = "controller_configuration.hpp";

/// The controller's parts, its parameters and its targets, every number in the controller's own
/// scalar, bit for bit what the simulation uses. The same scene gives the same text.
/// @throws configure::ConfigurationError  an open-loop scene, or a target too late for an image
std::string controller_header(const scene::Scene& scene);

/// The same of the controller that has been designed for the scene; none in open loop.
std::string controller_header(const scene::Scene& scene,
                              const std::optional<configure::ControlDesign>& design);

}  // namespace sonoglide::emulated
