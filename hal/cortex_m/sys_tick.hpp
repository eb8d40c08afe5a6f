/// The Cortex-M's own timer as a free-running counter.
#pragma once

#include <cstdint>

namespace sonoglide::hal::cortex_m {

/// Source: Arm, ARMv7-M Architecture Reference Manual, SysTick; ARMv6-M and ARMv8-M have the same.
struct SysTickRegisters {
  volatile std::uint32_t control;
  volatile std::uint32_t reload;
  volatile std::uint32_t value;  ///< counts down
};

extern "C" SysTickRegisters sys_tick;  ///< address from the linker script

/// Counts processor clocks, 24 bits, without an interrupt.
template <std::uint32_t clock_hz>
class SysTick {
 public:
  static constexpr std::uint32_t hz = clock_hz;
  static constexpr std::uint32_t largest = 0xffffff;

  SysTick() {
    sys_tick.reload = largest;
    sys_tick.value = 0;
    sys_tick.control = enabled | processor_clock;
  }

  std::uint32_t ticks() const { return largest - sys_tick.value; }

 private:
  enum Control : std::uint32_t { enabled = 1, processor_clock = 4 };
};

}  // namespace sonoglide::hal::cortex_m
