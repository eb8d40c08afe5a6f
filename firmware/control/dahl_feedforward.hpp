/// Feedforward for a Dahl contact.
#pragma once

#include "firmware/control/friction_level.hpp"
#include "firmware/friction/dahl_inverse_map.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Inverse Dahl map at λ = Kt·Vt/(ω·Fc), the travel of the sliding per radian of the carrier over
/// the presliding distance.
template <class Scalar>
class DahlFeedforward {
 public:
  struct Parameters {
    /// Kt·X̂ / force full scale, X̂ the vibration amplitude at full drive.
    numeric::Split<Scalar> contact_force;
  };

  explicit DahlFeedforward(const Parameters& parameters) : parameters_(parameters) {}

  void set_friction(const FrictionLevel<Scalar>& friction) {
    full_speed_travel_ = friction::quotient(parameters_.contact_force, friction.level());
  }

  /// Velocity ratio at which the friction ratio (base 2, in [0, 1/2]) is reached.
  /// @param speed  |Vt|, base the peak vibration velocity at full drive; > 0.
  Scalar velocity_ratio(Scalar half_ratio, Scalar speed) const {
    return friction::dahl_velocity_ratio(
        half_ratio, friction::product(full_speed_travel_, numeric::split(speed)));
  }

 private:
  Parameters parameters_;
  numeric::Split<Scalar> full_speed_travel_{};  ///< λ at a speed of 1
};

}  // namespace sonoglide::control
