/// A quadrature encoder at PB2 (A) and PC12 (B), counted by TIM5: four counts in a period of its lines, upward where A
/// leads B, modulo 2^32, from 0 at the start. The carrier's timer latches the count at the end of each of its periods.
#pragma once

#include <cstdint>

#include "hal/nucleo_g474re/control_registers.hpp"

namespace sonoglide::hal::nucleo_g474re {

/// Once the carrier runs.
void start_encoder();

/// At the end of the last carrier period.
inline std::uint32_t latched_count() {
  return encoder_timer.compare[2];
}

}  // namespace sonoglide::hal::nucleo_g474re
