/// A drive that may use all that the actuator can do.
#pragma once

#include <cstdint>

#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

template <class Scalar>
class FullDrive {
 public:
  struct Parameters {};

  explicit FullDrive(const Parameters&) {}

  static constexpr Scalar highest() { return numeric::from_code<Scalar>(INT32_MAX); }
};

}  // namespace sonoglide::control
