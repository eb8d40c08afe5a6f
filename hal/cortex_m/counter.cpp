// The system timer of a Cortex-M as a counter. Source: Arm, ARMv6-M and ARMv7-M Architecture
// Reference Manuals, system timer.
#include "hal/start/counter.hpp"

namespace {

struct SystemTimer {
  volatile std::uint32_t control;
  volatile std::uint32_t reload;
  volatile std::uint32_t current;
};

constexpr std::uintptr_t timer_address = 0xE000E010;
constexpr std::uint32_t widest = 0x00FFFFFF;
constexpr std::uint32_t enabled_on_processor_clock = 5;

SystemTimer& timer() {
  return *reinterpret_cast<SystemTimer*>(timer_address);
}

}  // namespace

extern "C" {

void start_counter() {
  timer().reload = widest;
  timer().current = 0;  // any write clears it
  timer().control = enabled_on_processor_clock;
}

// 24 bits that fall, made to rise and to wrap with the word: 256 to a tick.
std::uint32_t read_counter() {
  return (widest - timer().current) << 8;
}

}  // extern "C"
