/// Friction ratio under a prescribed sinusoidal vibration, by the closed form of the scene's law.
#pragma once

#include "host_sim/scene/scene.hpp"

namespace sonoglide::design {

double carrier_rad_per_s(const scene::Scene& scene);

/// Mean friction over the undriven one, as firmware/friction has it for every law; of normal_coulomb
/// while its contact stays closed.
///
/// @param sliding_m_per_s    > 0
/// @param vibration_m_per_s  peak velocity v̂, > 0
double closed_form_ratio(const scene::Scene& scene, double sliding_m_per_s,
                         double vibration_m_per_s);

/// A friction ratio and the least vibration that gives it.
struct RequiredVibration {
  double friction_ratio;
  double velocity_m_per_s;  ///< peak
};

/// The vibration that gives a ratio; friction_ratio differs from the one asked for where no
/// vibration up to 10^6 times the sliding, of normal_coulomb none that leaves the contact closed,
/// gives that: it is the lowest then.
///
/// @param ratio  less than without vibration
RequiredVibration closed_form_vibration(const scene::Scene& scene, double sliding_m_per_s,
                                        double ratio);

/// Drive force that a vibration takes without a contact [N].
double force_N(const scene::Scene& scene, double vibration_m_per_s);

}  // namespace sonoglide::design
