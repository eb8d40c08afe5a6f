/// The friction force is not learnt again while the drive is on.
#pragma once

namespace sonoglide::control {

template <class Scalar>
class NoRelearning {
 public:
  struct Parameters {};
  static constexpr bool relearns = false;

  explicit NoRelearning(const Parameters&) {}
};

}  // namespace sonoglide::control
