/// No command shaping: for plants without a natural mode, and to show the effect of the notch.
#pragma once

namespace sonoglide::control {

template <class ScalarT>
class NoShaping {
 public:
  using Scalar = ScalarT;
  struct Parameters {};

  explicit NoShaping(const Parameters&) {}
  void restart() {}
  Scalar shape(Scalar amplitude) { return amplitude; }
};

}  // namespace sonoglide::control
