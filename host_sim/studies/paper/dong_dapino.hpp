/// Normal vibration of a pin on a disc at 22 kHz: S. Dong and M. J. Dapino, Journal of Visualized
/// Experiments (2015), 10.3791/52931.
#pragma once

#include "host_sim/studies/paper/range.hpp"

namespace sonoglide::paper {

/// Measured.
inline constexpr double dong_velocities_m_per_s[] = {20.3e-3, 87e-3};
inline constexpr double dong_reductions[] = {0.62, 0.29};

/// From which speed on such a vibration gains nothing, Vc = (mu kz/kx) omega A (see
/// friction::normal_vibration_ratio). Neither amplitude nor contact is published: amplitudes of 0.5
/// to 5 um, coefficients of 0.1 to 0.8, kz/kx of a Hertzian contact of Poisson's number 0.3.
Range dong_critical_velocities_m_per_s();

inline constexpr const char* dong_range =
    "amplitude up to the indentation; 0.5 to 5 um; coefficient 0.1 to 0.8; Hertzian springs";

/// Reductions at such a speed, over that range.
/// @param velocity_m_per_s  >= 0
Range dong_normal(double velocity_m_per_s);

/// A contact by what counts for the law.
struct NormalContact {
  double critical_velocity_m_per_s;
  double amplitude_ratio;  ///< beyond 1 the contact opens
};

/// What the contact would have to be for the law to give both measured reductions.
NormalContact dong_contact();

}  // namespace sonoglide::paper
