#include "hal/microbit/board.hpp"

#include <cstddef>

// Source: Nordic, nRF51 Series Reference Manual, TIMER.
namespace sonoglide::hal::microbit {
namespace {

struct TimerRegisters {
  volatile std::uint32_t start;
  std::uint32_t reserved_0[15];
  volatile std::uint32_t capture;  // the counter, into captured
  std::uint32_t reserved_1[304];
  volatile std::uint32_t mode;
  volatile std::uint32_t width;
  std::uint32_t reserved_2;
  volatile std::uint32_t prescaler;
  std::uint32_t reserved_3[11];
  volatile std::uint32_t captured;
};
static_assert(offsetof(TimerRegisters, capture) == 0x040);
static_assert(offsetof(TimerRegisters, mode) == 0x504);
static_assert(offsetof(TimerRegisters, prescaler) == 0x510);
static_assert(offsetof(TimerRegisters, captured) == 0x540);

extern "C" TimerRegisters timer0;  // address from memory.ld

constexpr std::uint32_t count_time = 0;
constexpr std::uint32_t bits_32 = 3;

}  // namespace

Timer::Timer() {
  timer0.mode = count_time;
  timer0.width = bits_32;
  timer0.prescaler = 0;
  timer0.start = 1;
}

std::uint32_t Timer::ticks() const {
  timer0.capture = 1;
  return timer0.captured;
}

}  // namespace sonoglide::hal::microbit
