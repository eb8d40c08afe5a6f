/// A board to start from: an imagined microcontroller with a carrier timer, two 12-bit converters
/// and a 10-bit drive. Copy the folder, write the registers of the real one, keep the shape.
#pragma once

#include <cstdint>

#include "hal/board.hpp"

namespace sonoglide::hal::template_board {

/// What the carrier timer and the converters that it triggers show to the processor.
struct CarrierRegisters {
  volatile std::uint32_t periods;       ///< drive phases 0 so far, free running
  volatile std::uint32_t stop;          ///< not 0: the operator asks for the end
  volatile std::uint32_t force;         ///< 0 … 4095, mean over the last carrier period
  volatile std::uint32_t force_ready;   ///< the period that `force` belongs to, as `periods` counts
  volatile std::uint32_t velocity;      ///< 0 … 4095
  volatile std::uint32_t amplitude;     ///< 0 … 1023, taken over at the next drive phase 0
  volatile std::uint32_t period_ticks;  ///< clocks in a carrier period
};

extern "C" CarrierRegisters carrier;  ///< address from memory.ld

/// Serves one carrier period after the other by polling: no interrupt, the same time every period.
class Board {
 public:
  /// A period that went by without an answer, or whose conversion is not there, is not fresh: the
  /// controller then switches the drive off and keeps the cause.
  bool sample(Sample& sample) {
    while (carrier.periods == period_) {
      if (carrier.stop != 0) {
        carrier.amplitude = 0;
        return false;
      }
    }
    const std::uint32_t now = carrier.periods;
    const std::uint32_t force = carrier.force;
    const std::uint32_t velocity = carrier.velocity;
    const bool on_time = now == period_ + 1;
    const bool converted = carrier.force_ready == now;
    sample = {left_justified(force), left_justified(velocity), at_rail(force), on_time && converted,
              at_rail(velocity)};
    period_ = now;
    return true;
  }

  void drive(const Drive& drive) {
    carrier.amplitude = static_cast<std::uint32_t>(drive.amplitude) >> (31 - amplitude_bits);
  }

 private:
  static constexpr unsigned converter_bits = 12;
  static constexpr unsigned amplitude_bits = 10;

  /// A converter's offset binary as a signed code whose full scale is 2^31.
  static std::int32_t left_justified(std::uint32_t code) {
    constexpr std::uint32_t sign = 0x80000000U;
    return static_cast<std::int32_t>((code << (32 - converter_bits)) ^ sign);
  }

  static bool at_rail(std::uint32_t code) {
    return code == 0 || code == (1U << converter_bits) - 1;
  }

  std::uint32_t period_ = carrier.periods;
};

}  // namespace sonoglide::hal::template_board
