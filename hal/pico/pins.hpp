/// What a pin of the chip is used for.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/pico/chip.hpp"

namespace sonoglide::hal::pico {

/// Source: Raspberry Pi, RP2040 and RP2350 Datasheets, GPIO functions.
enum class PinFunction : std::uint32_t { uart = 2, modulator = 4, software = 5, none = 31 };

struct PinRegisters {
  volatile std::uint32_t status;
  volatile std::uint32_t control;
};

struct PadRegisters {
  volatile std::uint32_t supply;
  volatile std::uint32_t pin[30];
};

// Addresses from memory.ld.
extern "C" {
extern PinRegisters pins[30];
extern PadRegisters pads;
}

inline constexpr std::uint32_t schmitt_trigger = 1U << 1;
inline constexpr std::uint32_t pull_up = 1U << 3;
inline constexpr std::uint32_t input_enabled = 1U << 6;
inline constexpr std::uint32_t output_disabled = 1U << 7;

inline void use_pin(std::size_t pin, PinFunction function, std::uint32_t pad) {
  pads.pin[pin] = pad;
  pins[pin].control = static_cast<std::uint32_t>(function);
}

/// An output, held low while nothing drives it.
inline void drive_pin(std::size_t pin, PinFunction function) {
  use_pin(pin, function, output_pad);
}

inline void receive_on_pin(std::size_t pin, PinFunction function) {
  use_pin(pin, function, pull_up | schmitt_trigger | input_enabled | output_disabled);
}

inline void leave_to_converter(std::size_t pin) {
  use_pin(pin, PinFunction::none, output_disabled);
}

/// Low at once, whatever drives the pin.
inline void hold_low(std::size_t pin) {
  pins[pin].control =
      static_cast<std::uint32_t>(PinFunction::software) | output_low | output_enabled;
}

}  // namespace sonoglide::hal::pico
