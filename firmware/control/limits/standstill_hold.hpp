/// The drive while the sliding is too slow for a friction ratio.
#pragma once

#include <cstdint>

#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Below the speed floor the last request stays in force for a stated time, so that a reversal or a
/// short stop does not disturb the vibration. Then it falls to zero along a straight line.
template <class Scalar>
class StandstillHold {
 public:
  struct Parameters {
    std::uint32_t hold_periods;  ///< for which the request stands
    Scalar fall_per_period;      ///< of the amplitude after that, > 0; base: the actuator's limit

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("hold_periods", self.hold_periods);
      visit("fall_per_period", self.fall_per_period);
    }
  };

  explicit StandstillHold(const Parameters& parameters) : parameters_(parameters) {}

  /// The sliding is fast enough.
  void restart() { held_ = 0; }

  /// One call for each period below the floor.
  /// @param requested  amplitude of the last period
  Scalar request(Scalar requested) {
    if (held_ < parameters_.hold_periods) {
      ++held_;
      return requested;
    }
    return parameters_.fall_per_period < requested ? requested - parameters_.fall_per_period
                                                   : Scalar{};
  }

 private:
  Parameters parameters_;
  std::uint32_t held_ = 0;
};

}  // namespace sonoglide::control
