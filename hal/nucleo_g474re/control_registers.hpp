/// Clocks, pins and flash control of the STM32G474.
#pragma once

#include <cstddef>
#include <cstdint>

namespace sonoglide::hal::nucleo_g474re {

/// Source: ST, RM0440, RCC registers.
struct ClockRegisters {
  volatile std::uint32_t control;
  volatile std::uint32_t calibration;
  volatile std::uint32_t configuration;
  volatile std::uint32_t pll;
  std::uint32_t reserved_0[3];
  volatile std::uint32_t interrupts;
  std::uint32_t reserved_4[10];
  volatile std::uint32_t ahb1_enable;
  volatile std::uint32_t ahb2_enable;
  std::uint32_t reserved_1[2];
  volatile std::uint32_t apb1_enable;
  std::uint32_t reserved_2;
  volatile std::uint32_t apb2_enable;
  std::uint32_t reserved_3[12];
  volatile std::uint32_t reset_status;
};
static_assert(offsetof(ClockRegisters, interrupts) == 0x1c);
static_assert(offsetof(ClockRegisters, ahb1_enable) == 0x48);
static_assert(offsetof(ClockRegisters, apb1_enable) == 0x58);
static_assert(offsetof(ClockRegisters, apb2_enable) == 0x60);
static_assert(offsetof(ClockRegisters, reset_status) == 0x94);

/// Source: ST, RM0440, embedded flash memory registers.
struct FlashRegisters {
  volatile std::uint32_t access;
  std::uint32_t reserved_0;
  volatile std::uint32_t key;
  std::uint32_t reserved_1;
  volatile std::uint32_t status;
  volatile std::uint32_t control;
  volatile std::uint32_t correction;
};
static_assert(offsetof(FlashRegisters, correction) == 0x18);

/// Source: ST, RM0440, GPIO registers.
struct PortRegisters {
  volatile std::uint32_t mode;
  volatile std::uint32_t output_type;
  volatile std::uint32_t speed;
  volatile std::uint32_t pull;
  volatile std::uint32_t input;
  volatile std::uint32_t output;
  volatile std::uint32_t set_and_reset;
  volatile std::uint32_t lock;
  volatile std::uint32_t function[2];  ///< four bits a pin
};
static_assert(offsetof(PortRegisters, function) == 0x20);

/// Of the timers with a break; TIM5 has neither that nor repetitions.
/// Source: ST, RM0440, TIM1/TIM8/TIM20 and TIM2/TIM3/TIM4/TIM5 registers.
struct TimerRegisters {
  volatile std::uint32_t control_1;
  volatile std::uint32_t control_2;
  volatile std::uint32_t slave_mode;
  volatile std::uint32_t interrupting;
  volatile std::uint32_t status;
  volatile std::uint32_t generate;
  volatile std::uint32_t compare_mode[2];
  volatile std::uint32_t outputs;
  volatile std::uint32_t counter;
  volatile std::uint32_t prescaler;
  volatile std::uint32_t reload;
  volatile std::uint32_t repetitions;
  volatile std::uint32_t compare[4];
  volatile std::uint32_t break_control;
};
static_assert(offsetof(TimerRegisters, compare) == 0x34);
static_assert(offsetof(TimerRegisters, break_control) == 0x44);

// Addresses from memory.ld.
extern "C" {
extern ClockRegisters clock_control;
extern FlashRegisters flash_control;
extern PortRegisters port_a;
extern PortRegisters port_b;
extern PortRegisters port_c;
extern TimerRegisters carrier_timer;   ///< TIM1
extern TimerRegisters sampling_timer;  ///< TIM8
extern TimerRegisters encoder_timer;   ///< TIM5
}

inline constexpr std::uint32_t update_event = 1U << 0;  ///< of a timer's status
/// Likewise: its legs were made low by its line, or by a fault of the chip. Neither can be cleared while that lasts.
inline constexpr std::uint32_t broken_by_line = 1U << 7;
inline constexpr std::uint32_t broken_by_chip = 1U << 13;

/// The outputs of the carrier are low by the timer while the break input, or a fault that the chip finds,
/// holds them; what else is in this register stays as it is.
inline constexpr std::uint32_t outputs_off = 1U << 8      // settings locked, level 1
                                             | 1U << 10   // low, not floating, while off
                                             | 1U << 12;  // a break by a low input
inline constexpr std::uint32_t outputs_on = outputs_off | 1U << 15;

/// A pin for a peripheral.
inline void use_pin(PortRegisters& port, unsigned pin, std::uint32_t function, std::uint32_t pull) {
  constexpr std::uint32_t of_peripheral = 2;
  port.pull = (port.pull & ~(3U << (2 * pin))) | pull << (2 * pin);
  volatile std::uint32_t& functions = port.function[pin / 8];
  const unsigned at = 4 * (pin % 8);
  functions = (functions & ~(15U << at)) | function << at;
  port.mode = (port.mode & ~(3U << (2 * pin))) | of_peripheral << (2 * pin);
}

inline constexpr std::uint32_t pulled_up = 1;
inline constexpr std::uint32_t pulled_down = 2;

}  // namespace sonoglide::hal::nucleo_g474re
