/// The steps in which a controller is designed, one after another; each adds to the design.
#pragma once

#include "host_sim/configure/control_design.hpp"
#include "host_sim/configure/nominal_plant.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

// What a controller's per-unit numbers are multiples of, and the limits that its sensors set.

/// Force of one code of the converter; 0 of an ideal one.
double code_N(const scene::Sensor& sensor);

/// Between two codes of a controller, of full scale; 0 in floating point.
double resolution(scene::Arithmetic arithmetic);

/// In which the contact sticks before it slips.
double presliding_m(const NominalPlant& plant);

/// Scales, friction, contact and speed floor of a design.
/// @throws ConfigurationError  speeds or forces outside the per-unit range, a vibration that never
///         settles, a sensor that is too coarse or too narrow
void design_scales(const scene::Scene& scene, const NominalPlant& plant, ControlDesign& design);

// Feedback on the friction ratio, and what keeps the natural mode quiet where the drive is fed
// forward.

/// The notch that a scene's controller.shaping names, of three taps where it names none, as far as the
/// mode allows one; with its range.
void design_named_notch(const scene::Scene& scene, const NaturalMode& mode,
                        FeedforwardDesign& found);

/// Of a drive that is fed forward: the notch, and a regulator behind it.
FeedforwardDesign design_feedforward(const scene::Scene& scene, const NominalPlant& plant,
                                     ControlDesign& design);

/// Around an inner loop that follows a small change of its velocity within so many periods; while
/// it follows a large one the integral waits.
void design_outer_regulator(const scene::Scene& scene, const NominalPlant& plant,
                            double following_periods, ControlDesign& design);

/// The slew limit holds behind the shaper, whose taps may add up.
void design_slew(const scene::Drive& drive, ControlDesign& design);

// What a controller is to notice, and after how long.

/// @pre regulator and vibration are designed
void design_supervision(const scene::Scene& scene, const NominalPlant& plant,
                        ControlDesign& design);

// When and for how long the undriven friction force is learnt.

/// The contact must slide through its presliding travel, and the sensor settle, before the friction
/// force can be learnt; in both directions where the sliding turns meanwhile.
/// @throws ConfigurationError  controller.calibration_s is too short for that
void design_calibration(const scene::Scene& scene, const NominalPlant& plant,
                        ControlDesign& design);

/// A pause long enough for the presliding travel, and for as many readings as their noise asks for.
/// @throws ConfigurationError  controller.relearn_every_s cannot be kept
void design_relearning(const scene::Scene& scene, const NominalPlant& plant, ControlDesign& design);

/// Friction learnt while driving.
/// @pre supervision and slew limit are designed
/// @throws ConfigurationError  controller.friction = "tracked" where the controller has no map of the
///         friction, or another key contradicts it
void design_tracking(const scene::Scene& scene, const NominalPlant& plant, ControlDesign& design);

// A target along the sliding distance.

/// Nothing where the scene has no texture.
/// @pre vibration and lead are designed
/// @throws ConfigurationError  controller.target_texture: a period of few steps, or one whose targets
///         the arithmetic does not tell apart
void design_texture(const scene::Scene& scene, ControlDesign& design);

}  // namespace sonoglide::configure
