/// A drive whose current nobody limits.
#pragma once

namespace sonoglide::control {

template <class Scalar>
class FullCurrent {
 public:
  struct Parameters {};
  static constexpr bool limits = false;

  explicit FullCurrent(const Parameters&) {}
};

}  // namespace sonoglide::control
