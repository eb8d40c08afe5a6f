#include "host_sim/configure/friction/vibration_map.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/control/friction/coulomb_feedforward.hpp"
#include "firmware/control/friction/dahl_feedforward.hpp"
#include "firmware/control/friction/friction_level.hpp"
#include "firmware/friction/inverse_table.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::configure {

double VibrationMap::velocity_m_per_s(double friction_ratio,
                                      double sliding_velocity_m_per_s) const {
  const double speed = std::abs(sliding_velocity_m_per_s) / largest_m_per_s;
  if (friction_ratio >= 1.0 || speed == 0.0) {
    return 0.0;
  }
  if (speed >= 1.0) {
    return largest_m_per_s;
  }
  if (kind == scene::FrictionMap::coulomb) {
    const control::CoulombFeedforward<double> map({});
    return largest_m_per_s * std::min(1.0, map.amplitude(0.5 * friction_ratio, speed));
  }
  if (kind == scene::FrictionMap::tabulated) {
    return inverse == nullptr ? 0.0 : tabulated_m_per_s(friction_ratio, speed);
  }
  control::DahlFeedforward<double> map({numeric::split(contact)});
  map.set_friction(control::FrictionLevel<double>(1.0));
  return largest_m_per_s * std::min(1.0, map.amplitude(0.5 * friction_ratio, speed));
}

double VibrationMap::tabulated_m_per_s(double friction_ratio, double speed) const {
  const double travel =
      largest_m_per_s / (inverse->reference_m_per_s * (inverse->over_force ? level : 1.0));
  return largest_m_per_s * std::min(1.0, friction::tabulated_vibration_velocity(
                                             0.5 * friction_ratio, speed, 0.5 * travel,
                                             inverse->reach, inverse->form, inverse->table));
}

}  // namespace sonoglide::configure
