/// No calibration: the configured friction force is trusted.
#pragma once

namespace sonoglide::control {

template <class Scalar>
class TrustedFriction {
 public:
  struct Parameters {};

  explicit TrustedFriction(const Parameters&) {}
  void restart() {}
  static constexpr bool learning() { return false; }
  void learn(Scalar, Scalar, bool) {}
  Scalar friction_force(Scalar configured) const { return configured; }
  Scalar without_offset(Scalar force) const { return force; }
};

}  // namespace sonoglide::control
