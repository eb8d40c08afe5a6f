/// The cubic Stribeck curve by its least friction, which is what one can measure.
#pragma once

namespace sonoglide::paper {

/// mu(v) = mu_s sgn v - alpha v + beta v^3 with its least value (1 - drop) mu_s at v_m:
///   alpha v_m / mu_s = 3/2 drop,  beta v_m^3 / mu_s = 1/2 drop.
struct StribeckShape {
  double drop;       ///< [-]
  double vibration;  ///< peak vibration velocity / v_m [-]
};

/// Mean friction under a sinusoidal vibration over that without at the same speed.
/// @param velocity_ratio  Vt / peak vibration velocity [-]
double stribeck_vibration_ratio(double velocity_ratio, const StribeckShape& shape);

}  // namespace sonoglide::paper
