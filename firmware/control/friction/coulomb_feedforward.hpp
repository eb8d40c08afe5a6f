/// Feedforward for a Coulomb contact.
#pragma once

#include <cstdint>

#include "firmware/control/friction/friction_level.hpp"
#include "firmware/control/interface/part_name.hpp"
#include "firmware/numeric/fixed_elementary.hpp"
#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// r = sin(πρ/2): independent of speed, contact stiffness and friction force.
template <class ScalarT>
class CoulombFeedforward {
 public:
  static constexpr PartName part_name{"friction/coulomb_feedforward", "CoulombFeedforward"};
  using Scalar = ScalarT;

  struct Parameters {};

  explicit CoulombFeedforward(const Parameters&) {}
  static constexpr void settle_at(const Parameters& /*parameters*/) {}
  void set_friction(const FrictionLevel<Scalar>&) {}

  /// Drive amplitude in [0, 1] at which the friction ratio is reached; the largest value where none
  /// does.
  /// @param half_ratio  friction ratio on base 2, in [0, 1/2].
  /// @param speed       |Vt|, base the peak vibration velocity at full drive; > 0.
  Scalar amplitude(Scalar half_ratio, Scalar speed) const {
    const Scalar velocity_ratio = numeric::sin_pi(half_ratio);
    return speed < velocity_ratio ? speed / velocity_ratio : numeric::from_code<Scalar>(INT32_MAX);
  }
};

}  // namespace sonoglide::control
