/// Supervision of a reading that ought to move.
#pragma once

#include <cstdint>

#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// A reading is stuck if it has not changed by a single code although the commanded friction ratio
/// has moved far since the last change of the reading. A constant reading under a constant command
/// is no fault: a settled contact gives this, at any drive amplitude that a changing sliding speed
/// needs. A reading of the undriven friction needs a command still farther away, because a
/// vibration slower than the sliding does not lower friction.
template <class Scalar>
class StuckDetector {
 public:
  struct Parameters {
    std::uint16_t
        periods;  ///< granted to the reading to follow: the sensor's delay must fit in; 0:
                  ///< the drive may have no effect on the reading, nothing is concluded

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("periods", self.periods);
    }
  };

  /// Distance of the command that a live reading must show: a ratio of 1/4, on base 2.
  static constexpr Scalar telling_distance() { return numeric::from_real<Scalar>(0.125); }
  /// The same for a reading of the undriven friction: a ratio of 3/4.
  static constexpr Scalar telling_distance_undriven() { return numeric::from_real<Scalar>(0.375); }
  /// From here on a reading passes for undriven: a ratio of 15/16, on base 2.
  static constexpr Scalar undriven() { return numeric::from_real<Scalar>(0.46875); }

  explicit StuckDetector(const Parameters& parameters) : parameters_(parameters) {}

  void restart() { still_ = unread; }

  /// One call for each reading.
  /// @param reading    of the force sensor
  /// @param measured   the reading as a friction ratio on base 2
  /// @param commanded  friction ratio on base 2 that was commanded while the reading was made
  /// @param followed   the drive could follow that command; while it cannot, nothing is concluded
  /// @return true when the reading has stood still for the granted periods since the command became
  ///         telling
  bool stuck(Scalar reading, Scalar measured, Scalar commanded, bool followed) {
    if (reading != last_reading_ || still_ == unread) {
      last_reading_ = reading;
      last_ratio_ = commanded;
      still_ = 0;
      return false;
    }
    const Scalar telling = measured < undriven() ? telling_distance() : telling_distance_undriven();
    const bool told = still_ > 0 || telling <= numeric::abs(commanded - last_ratio_);
    if (told && followed && parameters_.periods > 0) {
      ++still_;
    }
    return still_ > 0 && still_ >= parameters_.periods;
  }

 private:
  static constexpr std::uint32_t unread = UINT32_MAX;  ///< no reading since restart

  Parameters parameters_;
  Scalar last_reading_{};
  Scalar last_ratio_{};           ///< commanded when the reading last changed
  std::uint32_t still_ = unread;  ///< periods since the command became telling
};

}  // namespace sonoglide::control
