// The system timer of a Cortex-M as a counter.
#include "hal/start/counter.hpp"

#include "hal/cortex_m/sys_tick.hpp"

using sonoglide::hal::cortex_m::SysTick;

extern "C" {

void start_counter() {
  SysTick::start();
}

// 24 bits, made to wrap with the word: 256 to a tick.
std::uint32_t read_counter() {
  return SysTick::ticks() << 8;
}

}  // extern "C"
