#include "hal/microbit/board.hpp"

#include <cstddef>
#include <cstdint>

// Source: Nordic, nRF51 Series Reference Manual, WDT, and the reset reason of POWER.
namespace sonoglide::hal::microbit {
namespace {

struct WatchdogRegisters {
  volatile std::uint32_t start;
  std::uint32_t reserved_0[320];
  volatile std::uint32_t reload_value;  // periods of 32.768 kHz, less one
  volatile std::uint32_t reload_enable;
  volatile std::uint32_t configuration;
  std::uint32_t reserved_1[60];
  volatile std::uint32_t reload;
};
static_assert(offsetof(WatchdogRegisters, reload_value) == 0x504);
static_assert(offsetof(WatchdogRegisters, configuration) == 0x50c);
static_assert(offsetof(WatchdogRegisters, reload) == 0x600);

// Addresses from memory.ld.
extern "C" {
extern WatchdogRegisters watchdog;
extern volatile std::uint32_t reset_reason;
}

constexpr std::uint32_t by_watchdog = 1U << 1;
constexpr std::uint32_t tenth_of_a_second = 3277 - 1;
constexpr std::uint32_t first_reload = 1;
constexpr std::uint32_t runs_in_sleep = 1;
constexpr std::uint32_t reload_word = 0x6e524635;

}  // namespace

Watchdog::Watchdog() : caused_reset_((reset_reason & by_watchdog) != 0) {
  reset_reason = by_watchdog;  // a set bit clears it
  watchdog.configuration = runs_in_sleep;
  watchdog.reload_value = tenth_of_a_second;
  watchdog.reload_enable = first_reload;
  watchdog.start = 1;
}

void Watchdog::feed() {
  watchdog.reload = reload_word;
}

}  // namespace sonoglide::hal::microbit
