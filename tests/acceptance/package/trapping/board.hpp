/// An MPS2 board with a defect: once, while it drives, it does what no processor can.
#pragma once

#include <cstdint>

#include "hal/mps2/board.hpp"
#include "hal/no_watchdog.hpp"
#include "hal/timed/drive_register.hpp"

namespace trapping {

/// An emulator's RAM is 0 at first.
[[gnu::section(".noinit")]] inline std::uint32_t trapped;

struct Watchdog : sonoglide::hal::NoWatchdog {
  static void feed() {
    if (drive_amplitude != 0 && trapped == 0) {
      trapped = 1;
      asm volatile("udf #0");
    }
  }
};

struct Hardware : sonoglide::hal::mps2::An385TimedHardware {
  using Watchdog = trapping::Watchdog;
};

}  // namespace trapping
