/// Whether the watchdog caused the last reset of an MPS2 board.
#pragma once

#include <cstdint>

namespace sonoglide::hal::mps2 {

// Addresses from the linker script.
extern "C" {
extern volatile std::uint32_t reset_information;  ///< CMSDK system controller, RSTINFO
extern volatile std::uint32_t reset_syndrome;     ///< SSE-200 system control, RESET_SYNDROME
}

/// Cortex-M3, M4 and M7. Source: Arm, Cortex-M System Design Kit, Technical Reference Manual.
struct ResetInformation {
  /// Returns whether it was the watchdog, and clears the record.
  static bool take_watchdog() {
    constexpr std::uint32_t by_watchdog = 1U << 1;
    const bool caused = (reset_information & by_watchdog) != 0;
    reset_information = by_watchdog;  // a set bit clears it
    return caused;
  }
};

/// Cortex-M33. Source: Arm, CoreLink SSE-200 Subsystem, Technical Reference Manual.
struct ResetSyndrome {
  /// Returns whether it was the watchdog, and clears the record.
  static bool take_watchdog() {
    constexpr std::uint32_t by_secure_watchdog = 1U << 2;
    const bool caused = (reset_syndrome & by_secure_watchdog) != 0;
    reset_syndrome = reset_syndrome & ~by_secure_watchdog;
    return caused;
  }
};

}  // namespace sonoglide::hal::mps2
