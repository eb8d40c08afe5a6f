#include "hal/netduinoplus2/board.hpp"

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
constexpr std::uint32_t divide_by_4 = 0;
constexpr std::uint32_t divide_by_256 = 6;
constexpr std::uint32_t tenth_of_a_second = 800 - 1;  // at 32 kHz / 4
constexpr std::uint32_t eight_seconds = 1024 - 1;     // at 32 kHz / 256

// A register takes over a new value after some cycles of the oscillator, and must not be written
// before.
void set_period(std::uint32_t prescaler, std::uint32_t reload) {
  independent_watchdog.key = write_word;
  independent_watchdog.prescaler = prescaler;
  independent_watchdog.reload = reload;
  while (independent_watchdog.status != 0) {
  }
  Watchdog::feed();
}

}  // namespace

Watchdog::Watchdog() : caused_reset_((reset_status & by_watchdog) != 0) {
  reset_status = reset_status | clear_reset_status;
  independent_watchdog.key = start_word;
  wait_short();
}

void Watchdog::feed() {
  independent_watchdog.key = feed_word;
}

void Watchdog::wait_long() {
  set_period(divide_by_256, eight_seconds);
}

void Watchdog::wait_short() {
  set_period(divide_by_4, tenth_of_a_second);
}

}  // namespace sonoglide::hal::netduinoplus2
