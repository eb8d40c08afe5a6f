/// The controller of a scene, and its plant, as C++ to be compiled into an image.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "host_sim/configure/experiment.hpp"
#include "host_sim/scene/names.hpp"

namespace sonoglide::emulated {

/// The name under which an image includes it.
inline constexpr const char* controller_header_name = "controller_configuration.hpp";

/// The controller's parts, its parameters and its targets, every number in the controller's own
/// scalar, bit for bit what the simulation uses. The same scene gives the same text.
/// @throws configure::ConfigurationError  an open-loop scene, or a target too late for an image
std::string controller_header(const configure::Experiment& experiment);

/// The number by which that header tells its design from others.
/// @throws configure::ConfigurationError  likewise
std::uint32_t design_number(const configure::Experiment& experiment);

// The plant of a scene as C++, to be compiled into an image beside the controller.

/// The name under which an image includes it.
inline constexpr const char* plant_header_name = "plant_configuration.hpp";

/// The arithmetics that such a plant computes in.
inline constexpr std::array plant_arithmetics = {
    scene::Named<scene::Arithmetic>{"float32", scene::Arithmetic::float32},
    scene::Named<scene::Arithmetic>{"q31", scene::Arithmetic::q31}};

/// A board that is the plant, with its parameters, and how many carrier periods of a run are whole.
/// The same scene gives the same text.
///
/// The solver is the image's own choice, whatever the scene names: Strang splitting, in float with
/// eight steps in a carrier period, in q31 with the 32 of FixedStrang. At Table 1 the friction
/// ratio of a period is within 6e-4 (float) and 4e-4 (q31) of the plant in double, at any drive
/// amplitude, over 100,000 periods. EventTaylor of order 8 is within 3e-4 in float, for six times
/// the instructions on a Cortex-M4F and half as much flash again.
///
/// @param arithmetic  of the plant, whatever the controller's: float32 or q31
/// @throws configure::ConfigurationError  an open-loop scene, a friction law that the solver is not
/// for,
///         a sliding velocity that changes, a sensor that is not ideal; in q31 also numbers that
///         the integers do not reach
std::string plant_header(const configure::Experiment& experiment, scene::Arithmetic arithmetic);

}  // namespace sonoglide::emulated
