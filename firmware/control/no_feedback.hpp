/// No feedback: the target goes to the feedforward as it is.
#pragma once

namespace sonoglide::control {

/// For a design with feedforward alone. The commands are those of an IntegralRegulator with a gain
/// of 0.
template <class Scalar>
class NoFeedback {
 public:
  struct Parameters {};

  static constexpr void scale_gain(Parameters&, Scalar) {}

  explicit NoFeedback(const Parameters&) {}
  void restart(Scalar) {}
  void hold() {}
  void target_changes(Scalar) {}
  void shift(Scalar, Scalar) {}
  Scalar propose(Scalar target, Scalar /*measured*/) const { return target; }
  void accept(bool, bool) {}
};

}  // namespace sonoglide::control
