/// Mean friction under a prescribed sinusoidal vibration, by the closed form of a law.
#pragma once

#include "host_sim/scene/scene.hpp"

namespace sonoglide::configure {

/// Mean friction over the undriven one, as firmware/friction has it for every law; of normal_coulomb
/// while its contact stays closed.
///
/// @param contact            its profiles play no part
/// @param carrier_rad_per_s  ω
/// @param sliding_m_per_s    > 0
/// @param vibration_m_per_s  peak velocity v̂, > 0
double mean_friction_ratio(const scene::Friction& contact, double carrier_rad_per_s,
                           double sliding_m_per_s, double vibration_m_per_s);

/// Of peak velocities.
struct VibrationRange {
  double least_m_per_s;
  double most_m_per_s;
};

/// Where the ratio of a sliding is looked for: from where no law lowers the friction by a millionth to
/// where the contact opens; without end where it does not.
VibrationRange vibration_range(const scene::Friction& contact, double carrier_rad_per_s,
                               double sliding_m_per_s);

}  // namespace sonoglide::configure
