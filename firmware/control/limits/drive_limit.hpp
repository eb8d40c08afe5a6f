/// A drive that is held below what the actuator can do.
#pragma once

#include <cstdint>

#include "firmware/control/interface/drive_command.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// A drive that may use all that the actuator can do.
template <class Scalar>
class FullDrive {
 public:
  struct Parameters {};

  explicit FullDrive(const Parameters&) {}

  static constexpr Scalar highest() { return numeric::from_code<Scalar>(INT32_MAX); }

  /// A drive that knows no ceiling, as it is.
  static constexpr Request<Scalar> held(const Request<Scalar>& driven, Limit /*named*/) {
    return driven;
  }
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

  /// A drive that knows no ceiling, of either sign, held below this one.
  /// @param driven  the drive that is asked for
  /// @param named  limit of a drive that would be larger
  Request<Scalar> held(const Request<Scalar>& driven, Limit named) const {
    if (!(parameters_.highest < FullDrive<Scalar>::highest()) ||
        numeric::abs(driven.amplitude) <= parameters_.highest) {
      return driven;
    }
    return {numeric::clamp_magnitude(driven.amplitude, parameters_.highest), named};
  }

 private:
  Parameters parameters_;
};

}  // namespace sonoglide::control
