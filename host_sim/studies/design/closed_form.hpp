/// Friction ratio under a prescribed sinusoidal vibration: what the controller's feedforward
/// believes.
#pragma once

#include <optional>

#include "host_sim/scene/scene.hpp"

namespace sonoglide::design {

/// The closed form of the scene's law, Dahl, Coulomb or the averaged Stribeck curve.
///
/// @param sliding_m_per_s    > 0
/// @param vibration_m_per_s  peak velocity v̂, > 0
double closed_form_ratio(const scene::Scene& scene, double sliding_m_per_s,
                         double vibration_m_per_s);

/// A friction ratio and the least vibration that gives it.
struct Vibration {
  double friction_ratio;
  double velocity_m_per_s;  ///< peak
};

/// The vibration that gives a ratio; friction_ratio differs from the one asked for where no
/// vibration up to 10^6 times the sliding gives that: it is the lowest then.
///
/// @param ratio  less than without vibration
Vibration closed_form_vibration(const scene::Scene& scene, double sliding_m_per_s, double ratio);

/// Drive force that a vibration takes without a contact [N].
double force_N(const scene::Scene& scene, double vibration_m_per_s);

}  // namespace sonoglide::design
