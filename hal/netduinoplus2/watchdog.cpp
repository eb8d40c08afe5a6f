#include "hal/netduinoplus2/watchdog.hpp"

#include <cstdint>

// Source: ST, RM0090, IWDG and the control and status register of RCC.
namespace sonoglide::hal::netduinoplus2 {
namespace {

struct WatchdogRegisters {
  volatile std::uint32_t key;
  volatile std::uint32_t prescaler;
  volatile std::uint32_t reload;
  volatile std::uint32_t status;
};

// Addresses from memory.ld.
extern "C" {
extern WatchdogRegisters independent_watchdog;
extern volatile std::uint32_t reset_status;
}

constexpr std::uint32_t by_watchdog = 1U << 29;
constexpr std::uint32_t clear_reset_status = 1U << 24;
constexpr std::uint32_t start_word = 0xcccc;
constexpr std::uint32_t write_word = 0x5555;
constexpr std::uint32_t feed_word = 0xaaaa;
constexpr std::uint32_t divide_by_256 = 6;
constexpr std::uint32_t eight_seconds = 1024 - 1;  // at 32 kHz

}  // namespace

Watchdog::Watchdog() : caused_reset_((reset_status & by_watchdog) != 0) {
  reset_status = reset_status | clear_reset_status;
  independent_watchdog.key = start_word;
  independent_watchdog.key = write_word;
  independent_watchdog.prescaler = divide_by_256;
  independent_watchdog.reload = eight_seconds;
  while (independent_watchdog.status != 0) {
  }
  feed();
}

void Watchdog::feed() {
  independent_watchdog.key = feed_word;
}

}  // namespace sonoglide::hal::netduinoplus2
