/// Feedforward for a Coulomb contact.
#pragma once

#include "firmware/control/friction_level.hpp"
#include "firmware/numeric/fixed_elementary.hpp"
#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// r = sin(πρ/2): independent of speed, contact stiffness and friction force.
template <class Scalar>
class CoulombFeedforward {
 public:
  struct Parameters {};

  explicit CoulombFeedforward(const Parameters&) {}
  void set_friction(const FrictionLevel<Scalar>&) {}

  /// Velocity ratio at which the friction ratio (base 2, in [0, 1/2]) is reached.
  Scalar velocity_ratio(Scalar half_ratio, Scalar /*speed*/) const {
    return numeric::sin_pi(half_ratio);
  }
};

}  // namespace sonoglide::control
