/// Feedback on the friction ratio, and what keeps the natural mode quiet where the drive is fed
/// forward.
#pragma once

#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// Of a drive that is fed forward: the notch, and a regulator behind it.
FeedforwardDesign design_feedforward(const scene::Scene& scene, const NominalPlant& plant,
                                     ControlDesign& design);

/// Around an inner loop that follows a small change of its velocity within so many periods; while
/// it follows a large one the integral waits.
void design_outer_regulator(const scene::Scene& scene, double following_periods,
                            ControlDesign& design);

/// The slew limit holds behind the shaper, whose taps may add up.
void design_slew(const scene::Drive& drive, ControlDesign& design);

}  // namespace sonoglide::configure
