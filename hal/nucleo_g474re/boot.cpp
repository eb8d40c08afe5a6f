// The clocks of the chip, before its program is loaded.
// Source: ST, RM0440, dynamic voltage scaling (range 1 boost mode), read access latency, RCC.
#include <cstdint>

#include "hal/cortex_m/loaded/load_program.hpp"
#include "hal/nucleo_g474re/clocks.hpp"
#include "hal/nucleo_g474re/control_registers.hpp"

namespace sonoglide::hal::nucleo_g474re {
namespace {

// Addresses from memory.ld.
extern "C" {
extern volatile std::uint32_t power_boost;   // PWR_CR5
extern volatile std::uint32_t power_status;  // PWR_SR2
}

constexpr std::uint32_t crystal_on = 1U << 16;
constexpr std::uint32_t crystal_ready = 1U << 17;
constexpr std::uint32_t crystal_watched =
    1U << 19;  // its failure is a non-maskable interrupt and a break
constexpr std::uint32_t pll_on = 1U << 24;
constexpr std::uint32_t pll_ready = 1U << 25;

constexpr std::uint32_t divider = 6;  // of the crystal: 4 MHz
constexpr std::uint32_t multiplier = 84;
static_assert(crystal_hz / divider * multiplier / 2 == system_hz);
constexpr std::uint32_t pll_setting = 3U                    // from the crystal
                                      | (divider - 1) << 4  //
                                      | multiplier << 8     //
                                      | 1U << 24;           // output R, divided by 2

constexpr std::uint32_t from_pll = 3;
constexpr std::uint32_t from_pll_halved = from_pll | 8U << 4;
constexpr std::uint32_t clock_in_force = 3U << 2;

constexpr std::uint32_t power_clock = 1U << 28;
constexpr std::uint32_t boost_off = 1U << 8;
constexpr std::uint32_t voltage_changing = 1U << 10;
/// Four waits for 168 MHz in boost mode. Neither prefetch nor caches: the program is in RAM, and what is read
/// from flash is what is in it.
constexpr std::uint32_t flash_waits = 4;

}  // namespace

extern "C" [[gnu::section(".boot")]] void start_clocks() {
  clock_control.control = clock_control.control | crystal_on;
  while ((clock_control.control & crystal_ready) == 0) {
  }
  clock_control.apb1_enable = clock_control.apb1_enable | power_clock;
  power_boost = power_boost & ~boost_off;
  while ((power_status & voltage_changing) != 0) {
  }
  flash_control.access = flash_waits;
  while (flash_control.access != flash_waits) {
  }
  clock_control.pll = pll_setting;
  clock_control.control = clock_control.control | pll_on;
  while ((clock_control.control & pll_ready) == 0) {
  }
  // The step to a clock above 80 MHz is made in two, a microsecond apart.
  clock_control.configuration = from_pll_halved;
  while ((clock_control.configuration & clock_in_force) != from_pll << 2) {
  }
  for (int i = 0; i < 100; ++i) {
    asm volatile("");
  }
  clock_control.configuration = from_pll;
  clock_control.control = clock_control.control | crystal_watched;
}

}  // namespace sonoglide::hal::nucleo_g474re
