/// An actuator whose amplitude may change at will.
#pragma once

namespace sonoglide::control {

template <class Scalar>
class NoSlewLimit {
 public:
  struct Parameters {};

  explicit NoSlewLimit(const Parameters&) {}
  Scalar limit(Scalar wanted, Scalar /*previous*/) const { return wanted; }
};

}  // namespace sonoglide::control
