/// What a settled loop shows of the friction force.
#pragma once

#include <cstdint>

#include "firmware/control/interface/drive_command.hpp"
#include "firmware/numeric/scalar.hpp"
#include "hal/board.hpp"

namespace sonoglide::app {

/// Nominal over true friction force, in thousandths: commanded over target ratio in a settled
/// loop. 0 if it is unknown. Limited to 65,535. Rounded down, from a commanded ratio that is
/// rounded to a millionth.
/// @param drive   the answer of the step.
/// @param target  friction ratio, millionths; 0: not known.
inline std::uint16_t mismatch_thousandths(const hal::Drive& drive, std::uint32_t target) {
  if (drive.settling != static_cast<std::uint8_t>(control::Settling::settled) || target == 0) {
    return 0;
  }
  // 2^31 is a ratio of 2.
  const auto commanded = static_cast<std::uint32_t>(
      (static_cast<std::uint64_t>(drive.commanded_ratio) * 2'000'000 + (1U << 30)) >> 31);
  return static_cast<std::uint16_t>(
      numeric::min<std::uint32_t>(commanded * 1000 / target, UINT16_MAX));
}

}  // namespace sonoglide::app
