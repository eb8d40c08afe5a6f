// The clocks of the chip, before its program is loaded.
// Source: Raspberry Pi, RP2040 and RP2350 Datasheets, resets, XOSC, PLL, clocks.
#include <cstddef>
#include <cstdint>

#include "hal/cortex_m/loaded/load_program.hpp"
#include "hal/pico/chip.hpp"
#include "hal/pico/resets.hpp"

namespace sonoglide::hal::pico {
namespace {

struct CrystalRegisters {
  volatile std::uint32_t control;
  volatile std::uint32_t status;
  volatile std::uint32_t dormant;
  volatile std::uint32_t startup;  // periods of 256 clocks
};

struct PllRegisters {
  volatile std::uint32_t status;  // with the divider of its input
  volatile std::uint32_t power_down;
  volatile std::uint32_t feedback_divider;
  volatile std::uint32_t post_dividers;
};

struct ClockRegisters {
  std::uint32_t outputs[12];
  volatile std::uint32_t reference_control;
  volatile std::uint32_t reference_divider;
  volatile std::uint32_t reference_selected;
  volatile std::uint32_t system_control;
  volatile std::uint32_t system_divider;
  volatile std::uint32_t system_selected;
  volatile std::uint32_t peripheral_control;
  std::uint32_t reserved[words_before_converter_clock];
  volatile std::uint32_t converter_control;
};
static_assert(offsetof(ClockRegisters, reference_control) == 0x30);
static_assert(offsetof(ClockRegisters, system_control) == 0x3c);
static_assert(offsetof(ClockRegisters, peripheral_control) == 0x48);

// Addresses from memory.ld.
extern "C" {
extern CrystalRegisters crystal;
extern PllRegisters system_pll;
extern PllRegisters usb_pll;
extern ClockRegisters clocks;
}

constexpr std::uint32_t crystal_enabled = 0xfab000;
constexpr std::uint32_t crystal_of_1_to_15_MHz = 0xaa0;
constexpr std::uint32_t startup_of_1_ms = crystal_hz / 256 / 1000 + 1;
constexpr std::uint32_t stable = 1U << 31;

constexpr std::uint32_t usb_oscillator_hz = 1200000000;
constexpr std::uint32_t locked = 1U << 31;
constexpr std::uint32_t all_down = 0x2d;
constexpr std::uint32_t post_dividers_down = 1U << 3;
constexpr std::uint32_t modulator_down = 1U << 2;

constexpr std::uint32_t from_crystal = 2;
constexpr std::uint32_t from_auxiliary = 1;  // of the system's clock: its PLL
constexpr std::uint32_t clock_enabled =
    1U << 11;  // from the system's clock; of the converter: from the other PLL

/// The output is crystal_hz * multiplier / (first * second).
[[gnu::section(".boot"), gnu::noinline]] void start_pll(PllRegisters& pll, std::uint32_t multiplier,
                                                        std::uint32_t first, std::uint32_t second) {
  pll.power_down = all_down;
  pll.status = 1;  // the crystal's clock, undivided
  pll.feedback_divider = multiplier;
  pll.power_down = post_dividers_down | modulator_down;
  while ((pll.status & locked) == 0) {
  }
  pll.post_dividers = first << 16 | second << 12;
  pll.power_down = modulator_down;
}

}  // namespace

extern "C" [[gnu::section(".boot")]] void start_clocks() {
  crystal.startup = startup_of_1_ms;
  crystal.control = crystal_enabled | crystal_of_1_to_15_MHz;
  while ((crystal.status & stable) == 0) {
  }
  clocks.system_control = 0;  // from the reference, while its PLL is set
  while ((clocks.system_selected & 1) == 0) {
  }
  clocks.reference_control = from_crystal;
  while ((clocks.reference_selected & 1U << from_crystal) == 0) {
  }
  release(reset_of_system_pll | reset_of_usb_pll);
  static_assert(system_hz == system_oscillator_hz / (5 * 2));
  start_pll(system_pll, system_oscillator_hz / crystal_hz, 5, 2);
  static_assert(converter_hz == usb_oscillator_hz / (5 * 5));
  start_pll(usb_pll, usb_oscillator_hz / crystal_hz, 5, 5);
  clocks.system_control = from_auxiliary;
  while ((clocks.system_selected & 1U << from_auxiliary) == 0) {
  }
  clocks.peripheral_control = clock_enabled;
  clocks.converter_control = clock_enabled;
}

}  // namespace sonoglide::hal::pico
