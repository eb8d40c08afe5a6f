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
/// State: the gain has 29 fraction bits, the offset is a code; gain times offset is exact in 60 fraction bits.
/// One 64-bit product and sum, rounded once, half up. Overflow: the code is limited to -2^31 ... 2^31 - 1, and
/// the sample is then at the rail. Error of a code that is not limited, against the real numbers offset and
/// gain: at most 0.5 code of the rounding, half a code times the gain of the offset, 2^-30 times the reading
/// less its offset of the gain; together at most 4 codes, 2e-9 of full scale. Offset 0 and gain 1 change no bit.
class ForceCalibration {
 public:
  constexpr ForceCalibration() = default;

  /// @param offset  millionths of full scale, two's complement, -250000 ... 250000
  /// @param gain    millionths, 500000 ... 2000000
  static constexpr ForceCalibration of(std::uint32_t offset, std::uint32_t gain) {
    const std::int64_t offset_code = rounded(static_cast<std::int32_t>(offset), 31);
    ForceCalibration result;
    result.gain_ = rounded(static_cast<std::int32_t>(gain), gain_bits);
    result.shift_ = half - offset_code * result.gain_;
    return result;
  }

  /// In place of the reading.
  constexpr void apply(hal::Sample& sample) const {
    const std::int64_t force = (std::int64_t{sample.friction_force} * gain_ + shift_) >> gain_bits;
    const bool beyond = force < INT32_MIN || force > INT32_MAX;
    sample.friction_force =
        beyond ? (force < 0 ? INT32_MIN : INT32_MAX) : static_cast<std::int32_t>(force);
    sample.force_at_rail = sample.force_at_rail || beyond;
  }

 private:
  static constexpr int gain_bits = 29;
  static constexpr std::int64_t half = std::int64_t{1} << (gain_bits - 1);

  /// millionths 2^bits / 10^6, half away from zero. Bit by bit: a small processor divides 64 bits with a kilobyte
  /// of code.
  static constexpr std::int32_t rounded(std::int32_t millionths, int bits) {
    constexpr std::uint32_t million = 1'000'000;
    const auto magnitude = static_cast<std::uint32_t>(millionths < 0 ? -millionths : millionths);
    std::uint32_t result = magnitude / million;
    std::uint32_t rest = magnitude % million;
    for (int i = 0; i < bits; ++i) {
      rest *= 2;
      result = 2 * result + (rest >= million ? 1U : 0U);
      rest -= rest >= million ? million : 0U;
    }
    result += 2 * rest >= million ? 1U : 0U;
    const auto code = static_cast<std::int32_t>(result);
    return millionths < 0 ? -code : code;
  }

  std::int32_t gain_ = std::int32_t{1} << gain_bits;
  std::int64_t shift_ = half;  ///< less gain times offset, and what rounds half up
};

/// Of the force that a controller reads.
template <class ControllerT>
using CalibrationOf =
    std::conditional_t<ControllerT::reads_force, ForceCalibration, NoForceCalibration>;

}  // namespace sonoglide::app
