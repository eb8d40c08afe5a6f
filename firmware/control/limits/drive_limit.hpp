/// A drive that is held below what the actuator can do.
#pragma once

#include <cstdint>
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// A drive that may use all that the actuator can do.
template <class Scalar>
class FullDrive {
 public:
  struct Parameters {};

  explicit FullDrive(const Parameters&) {}

  static constexpr Scalar highest() { return numeric::from_code<Scalar>(INT32_MAX); }
};

template <class Scalar>
class DriveLimit {
 public:
  struct Parameters {
    Scalar highest;  ///< amplitude, base: the actuator's limit; in [0, 1]

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("highest", self.highest);
    }
  };

  explicit DriveLimit(const Parameters& parameters) : parameters_(parameters) {}

  Scalar highest() const { return parameters_.highest; }

 private:
  Parameters parameters_;
};

}  // namespace sonoglide::control
