/// Supervision of a reading that ought to move.
#pragma once

#include <cstdint>

#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// A reading is stuck when it has not changed by a single code although the commanded friction
/// ratio has come far from where it stood at the reading's last change. A constant reading under a
/// constant command is no fault: a settled contact gives just that, at any drive amplitude that a
/// changing sliding speed asks for.
template <class Scalar>
class StuckDetector {
 public:
  struct Parameters {
    std::uint16_t periods;  ///< granted to the reading to follow: the sensor's delay must fit in
  };

  /// Distance of the command that a live reading must show: a ratio of 1/4, on base 2.
  static constexpr Scalar telling_distance() { return numeric::from_real<Scalar>(0.125); }

  explicit StuckDetector(const Parameters& parameters) : parameters_(parameters) {}

  void restart() { begun_ = false; }

  /// One call for each reading.
  /// @param half_ratio  friction ratio on base 2 that was commanded while the reading was made
  /// @param followed    the drive could follow that command; while it cannot, nothing is concluded
  /// @return true when the reading has stood still for the granted periods since the command became
  ///         telling
  bool stuck(Scalar reading, Scalar half_ratio, bool followed) {
    if (!begun_ || reading != last_reading_) {
      begun_ = true;
      last_reading_ = reading;
      last_ratio_ = half_ratio;
      still_ = 0;
      return false;
    }
    const bool told = still_ > 0 || telling_distance() <= numeric::abs(half_ratio - last_ratio_);
    if (told && followed) {
      ++still_;
    }
    return still_ >= parameters_.periods;
  }

 private:
  Parameters parameters_;
  Scalar last_reading_{};
  Scalar last_ratio_{};      ///< commanded when the reading last changed
  std::uint16_t still_ = 0;  ///< periods since the command became telling
  bool begun_ = false;
};

}  // namespace sonoglide::control
