/// Limit on how fast the requested drive amplitude may change.
#pragma once

#include "firmware/control/interface/part_name.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// An actuator whose amplitude may change at will.
template <class Scalar>
class NoSlewLimit {
 public:
  static constexpr PartName part_name{"limits/slew_limit", "NoSlewLimit"};
  struct Parameters {};

  explicit NoSlewLimit(const Parameters&) {}
  Scalar limit(Scalar wanted, Scalar /*previous*/) const { return wanted; }
};

template <class Scalar>
class SlewLimit {
 public:
  static constexpr PartName part_name{"limits/slew_limit", "SlewLimit"};
  struct Parameters {
    Scalar per_period;  ///< largest change of the amplitude in one carrier period, > 0

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("per_period", self.per_period);
    }
  };

  explicit SlewLimit(const Parameters& parameters) : parameters_(parameters) {}

  /// The nearest amplitude to `wanted` that may follow `previous`; both in [0, 1].
  Scalar limit(Scalar wanted, Scalar previous) const {
    if (parameters_.per_period < wanted - previous) {
      return numeric::min(previous + parameters_.per_period, wanted);
    }
    if (parameters_.per_period < previous - wanted) {
      return numeric::max(previous - parameters_.per_period, wanted);
    }
    return wanted;
  }

 private:
  Parameters parameters_;
};

}  // namespace sonoglide::control
