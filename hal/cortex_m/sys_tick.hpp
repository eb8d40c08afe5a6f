/// The Cortex-M's own timer, as a counter or as an interrupt.
#pragma once

#include <cstdint>

namespace sonoglide::hal::cortex_m {

/// Counts processor clocks up to 2^24, and from 0 again. Every user of it starts it alike.
///
/// Source: Arm, ARMv6-M and ARMv7-M Architecture Reference Manuals, system timer.
class SysTick {
 public:
  static constexpr std::uint32_t largest = 0x00ffffff;

  static void start() {
    registers().reload = largest;
    registers().current = 0;  // any write clears it
    registers().control = enabled_on_processor_clock;
  }

  /// Calls take_system_tick (hal/start/image_end.hpp) every so many processor clocks.
  /// @param clocks  2 ... 2^24
  static void interrupt_every(std::uint32_t clocks) {
    registers().reload = clocks - 1;
    registers().current = 0;
    registers().control = enabled_on_processor_clock | interrupting;
  }

  static void stop() { registers().control = 0; }

  static std::uint32_t ticks() { return largest - registers().current; }

 private:
  struct Registers {
    volatile std::uint32_t control;
    volatile std::uint32_t reload;
    volatile std::uint32_t current;  ///< falls
  };

  static constexpr std::uint32_t enabled_on_processor_clock = 5;  // bits 0 and 2
  static constexpr std::uint32_t interrupting = 2;

  static Registers& registers() { return *reinterpret_cast<Registers*>(0xE000E010); }
};

/// The same as the clock of a board.
template <std::uint32_t ClockHz>
class ProcessorClock {
 public:
  static constexpr std::uint32_t hz = ClockHz;
  static constexpr std::uint32_t largest = SysTick::largest;

  ProcessorClock() { SysTick::start(); }
  std::uint32_t ticks() const { return SysTick::ticks(); }
};

}  // namespace sonoglide::hal::cortex_m
