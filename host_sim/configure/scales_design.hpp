/// What a controller's per-unit numbers are multiples of, and the limits that its sensors set.
#pragma once

#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// Force of one code of the converter; 0 of an ideal one.
double code_N(const scene::Sensor& sensor);

/// In which the contact sticks before it slips.
double presliding_m(const NominalPlant& plant);

/// Scales, friction, contact and speed floor of a design.
/// @throws ConfigurationError  speeds or forces outside the per-unit range, a vibration that never
///         settles, a sensor that is too coarse or too narrow
void design_scales(const scene::Scene& scene, const NominalPlant& plant, ControlDesign& design);

}  // namespace sonoglide::configure
