// Source: Raspberry Pi, RP2040 and RP2350 Datasheets, watchdog and power-on state machine.
#include <cstddef>
#include <cstdint>

#include "hal/pico/board.hpp"

namespace sonoglide::hal::pico {
namespace {

struct WatchdogRegisters {
  volatile std::uint32_t control;
  volatile std::uint32_t load;
  volatile std::uint32_t reason;
  volatile std::uint32_t scratch[8];
};

struct PowerStateRegisters {
  volatile std::uint32_t forced_on;
  volatile std::uint32_t forced_off;
  volatile std::uint32_t by_watchdog;
};

// Addresses from memory.ld.
extern "C" {
extern WatchdogRegisters watchdog;
extern PowerStateRegisters power_states;
}

constexpr std::uint32_t by_timer = 1U << 0;
constexpr std::uint32_t counting_down = 1U << 30;
constexpr std::uint32_t still_under_debugger = 7U << 24;
/// The boot ROM resets by the watchdog as well; it leaves the first scratch register alone.
constexpr std::uint32_t mark = 0x536f6e6f;

}  // namespace

Watchdog::Watchdog()
    : caused_reset_((watchdog.reason & by_timer) != 0 && watchdog.scratch[0] == mark) {
  watchdog.scratch[0] = mark;
  start_watchdog_ticks();
  power_states.by_watchdog = all_but_oscillators;
  feed();
  watchdog.control = counting_down | still_under_debugger;
}

}  // namespace sonoglide::hal::pico
