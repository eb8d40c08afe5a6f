/// Stands in for transducer, contact and sensors on a board that has none.
#pragma once

#include <cstdint>

#include "hal/board.hpp"

namespace sonoglide::hal::timed {

/// A contact of one state. In each carrier period friction moves half of the way towards a value:
/// Fc v / a if the drive's peak velocity a exceeds the sliding velocity v, otherwise Fc. It is no
/// model of friction. The ratio is above that of the Coulomb contact, (2/pi) asin(v / a), by a
/// factor of up to pi/2, which the controller's feedback corrects.
///
/// Fc is half of the sensor's full scale and v a tenth of the peak velocity at full drive, as in
/// scenes that say nothing else and in the Table 1 contact.
class StandInContact {
 public:
  static constexpr std::int32_t undriven_friction = INT32_C(1) << 30;
  static constexpr std::int32_t velocity = INT32_C(0x0ccccccd);

  /// In force from the next live() on.
  /// @param amplitude  code, 0 ... 2^31 - 1.
  void drive(std::int32_t amplitude) { amplitude_ = amplitude; }

  /// One carrier period.
  void live() { friction_ += (settled_friction() - friction_) / 2; }

  Sample sample() const { return {friction_, velocity, false, true}; }

 private:
  /// To 2^-12 of Fc; 32 bits, since the smallest processor divides them fastest.
  std::int32_t settled_friction() const {
    constexpr int fraction_bits = 12;
    if (amplitude_ <= velocity) {
      return undriven_friction;
    }
    const std::int32_t ratio = velocity / ((amplitude_ >> fraction_bits) + 1);
    return ratio * (undriven_friction >> fraction_bits);
  }

  std::int32_t friction_ = undriven_friction;
  std::int32_t amplitude_ = 0;
};

}  // namespace sonoglide::hal::timed
