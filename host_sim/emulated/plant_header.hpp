/// The plant of a scene as C++, to be compiled into an image beside the controller.
#pragma once

#include <optional>
#include <string>

#include "host_sim/configure/control_design.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::emulated {

/// The name under which an image includes it.
inline constexpr const char* plant_header_name = "plant_configuration.hpp";

/// A board that is the plant, with its parameters, and how many carrier periods of a run are whole.
/// The same scene gives the same text.
///
/// The solver is the image's own choice, whatever the scene names: Strang splitting, in float with
/// eight steps in a carrier period, in q31 with the 32 of FixedStrang. At Table 1 the friction
/// ratio of a period is within 6e-4 (float) and 4e-4 (q31) of the plant in double, at any drive
/// amplitude, over 100,000 periods. EventTaylor of order 8 is within 3e-4 in float, for six times
/// the instructions on a Cortex-M4F and half as much flash again.
///
/// @param design      of the scene's controller: the codes of the seam are in its scales
/// @param arithmetic  of the plant, whatever the controller's: float32 or q31
/// @throws configure::ConfigurationError  an open-loop scene, a friction law that the solver is not
/// for,
///         a sliding velocity that changes, a sensor that is not ideal; in q31 also numbers that
///         the integers do not reach
std::string plant_header(const scene::Scene& scene,
                         const std::optional<configure::ControlDesign>& design,
                         scene::Arithmetic arithmetic);

/// The same with a design of its own.
std::string plant_header(const scene::Scene& scene, scene::Arithmetic arithmetic);

}  // namespace sonoglide::emulated
