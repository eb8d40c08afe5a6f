/// Offset and gain of a unit's force sensor.
#pragma once

#include <cstdint>
#include <type_traits>

#include "hal/board.hpp"

namespace sonoglide::app {

/// What a sensor without a force has: nothing to calibrate.
struct NoForceCalibration {
  static constexpr NoForceCalibration of(std::uint32_t /*offset*/, std::uint32_t /*gain*/) {
    return {};
  }
  static constexpr void apply(const hal::Sample& /*sample*/) {}
};

/// Force = gain (reading - offset), in codes of full scale 2^31.
///
/// State: the gain less 1 has 16 fraction bits, the offset times the gain is a code. The upper 16 bits of the
/// reading are multiplied, so that the product has 32 bits, and so has the whole correction. Overflow: the code
/// is limited to -2^31 ... 2^31 - 1, and the sample is then at the rail. Error of a code that is not limited,
/// against the real numbers offset and gain, of full scale: 2^-15 |gain - 1| of the bits that are not multiplied,
/// 2^-17 |force / gain| of the gain, 2^-23 of the offset; at most 2.5e-5 together. Offset 0 and gain 1 change no
/// bit.
class ForceCalibration {
 public:
  constexpr ForceCalibration() = default;

  /// @param offset  millionths of full scale, two's complement, -250000 ... 250000
  /// @param gain    millionths, 500000 ... 1500000
  static constexpr ForceCalibration of(std::uint32_t offset, std::uint32_t gain) {
    ForceCalibration result;
    // 2^10 / 15625 = 2^16 / 10^6.
    const std::int32_t scaled = (static_cast<std::int32_t>(gain) - 1'000'000) * 1024;
    result.gain_less_one_ = (scaled + (scaled < 0 ? -half : half)) / 15625;
    const auto millionths = static_cast<std::int32_t>(offset);
    // 2^31 / 10^6 = 2147.48365, without a division: 495 / 1024 = 0.48340.
    const std::int32_t offset_code = millionths * 2147 + (millionths * 495 >> 10);
    result.shift_ = offset_code + result.excess(offset_code);
    return result;
  }

  /// In place of the reading.
  constexpr void apply(hal::Sample& sample) const {
    const std::int32_t reading = sample.friction_force;
    const std::int32_t correction = excess(reading) - shift_;
    if (__builtin_add_overflow(reading, correction, &sample.friction_force)) {
      sample.friction_force = reading < 0 ? INT32_MIN : INT32_MAX;
      sample.force_at_rail = true;
    }
  }

 private:
  static constexpr std::int32_t half = 15625 / 2;

  /// (gain - 1) code
  constexpr std::int32_t excess(std::int32_t code) const { return (code >> 16) * gain_less_one_; }

  std::int32_t gain_less_one_ = 0;  ///< -2^15 ... 2^15
  std::int32_t shift_ = 0;          ///< gain times offset
};

/// Of the force that a controller reads.
template <class ControllerT>
using CalibrationOf =
    std::conditional_t<ControllerT::reads_force, ForceCalibration, NoForceCalibration>;

}  // namespace sonoglide::app
