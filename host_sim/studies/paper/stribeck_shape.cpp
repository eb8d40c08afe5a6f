#include "host_sim/studies/paper/stribeck_shape.hpp"

#include "firmware/friction/stribeck_friction_ratio.hpp"

namespace sonoglide::paper {

double stribeck_vibration_ratio(double velocity_ratio, const StribeckShape& shape) {
  const double fall = 1.5 * shape.drop * shape.vibration;
  const double rise = 0.5 * shape.drop * shape.vibration * shape.vibration * shape.vibration;
  const double r = velocity_ratio;
  return friction::stribeck_friction_ratio(r, fall, rise) / (1.0 - r * (fall - rise * r * r));
}

}  // namespace sonoglide::paper
